import { useEffect, useMemo, useRef } from "preact/hooks";
import type { ShownFourBar } from "../../api/messages";
import { type Camera, fitted, type Size } from "./camera";
import { follow } from "./clock";
import { allPins, linkPaths, pinsAt, pivotPath, reach, rowPath } from "./drawing";

/** The moving lines of a four-bar; they are moved by the clock without a new rendering. */
export function MovingLinks({ one, camera }: { one: ShownFourBar; camera: Camera }) {
  const [crank, coupler, rocker] = [
    useRef<SVGPathElement>(null),
    useRef<SVGPathElement>(null),
    useRef<SVGPathElement>(null),
  ];
  const tracer = useRef<SVGCircleElement>(null);
  useEffect(
    () =>
      follow((phase) => {
        const pins = pinsAt(one, phase);
        const paths = linkPaths(camera, pins);
        crank.current?.setAttribute("d", paths.crank);
        coupler.current?.setAttribute("d", paths.coupler);
        rocker.current?.setAttribute("d", paths.rocker);
        if (pins.p === null) return;
        tracer.current?.setAttribute("cx", String(camera.ox + pins.p.x * camera.sx));
        tracer.current?.setAttribute("cy", String(camera.oy - pins.p.y * camera.sy));
      }),
    [one, camera],
  );
  const pins = allPins(one.pins);
  return (
    <g class="synthesis-links">
      <path class="pivot" d={pivotPath(camera, pins.a0)} />
      <path class="pivot" d={pivotPath(camera, pins.b0)} />
      <path class="coupler" ref={coupler} />
      <path class="crank" ref={crank} />
      <path class="rocker" ref={rocker} />
      {one.motion.p.length > 0 && <circle class="tracer" r={4} ref={tracer} />}
    </g>
  );
}

const SIZE: Size = { width: 150, height: 110 };

/** A small moving picture of a candidate. */
export function Thumbnail({ one }: { one: ShownFourBar }) {
  const camera = useMemo(() => fitted(reach(one), SIZE, 12), [one]);
  return (
    <svg class="synthesis-thumbnail" viewBox={`0 0 ${SIZE.width} ${SIZE.height}`} aria-hidden="true">
      <path class="curve" d={rowPath(camera, one.curve)} />
      <MovingLinks one={one} camera={camera} />
    </svg>
  );
}

/** A still picture of a four-bar that was left out. */
export function StillThumbnail({ pins }: { pins: Record<string, readonly number[]> }) {
  const all = allPins(pins);
  const camera = useMemo(
    () => fitted([all.a0, all.b0, all.a, all.b, ...(all.p ? [all.p] : [])], { width: 90, height: 66 }, 10),
    [pins],
  );
  const paths = linkPaths(camera, all);
  return (
    <svg class="synthesis-thumbnail still" viewBox="0 0 90 66" aria-hidden="true">
      <path class="pivot" d={pivotPath(camera, all.a0, 6)} />
      <path class="pivot" d={pivotPath(camera, all.b0, 6)} />
      <path class="coupler" d={paths.coupler} />
      <path class="crank" d={paths.crank} />
      <path class="rocker" d={paths.rocker} />
    </svg>
  );
}
