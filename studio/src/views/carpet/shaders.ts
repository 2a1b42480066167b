/** The chart as one byte a knot and a palette: the colours are looked up for each pixel of the screen. */

export const VERTEX = `#version 300 es
uniform vec4 u_tile;   // first column and line, columns and lines of the tile
uniform vec4 u_view;   // middle of the view [knots], breadth and height of a knot [px]
uniform vec2 u_size;   // of the canvas [px]
out vec2 v_at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  v_at = corner * u_tile.zw;
  vec2 px = (u_tile.xy + v_at - u_view.xy) * u_view.zw;
  gl_Position = vec4(2.0 * px.x / u_size.x, -2.0 * px.y / u_size.y, 0.0, 1.0);
}`;

export const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D u_knots;
uniform sampler2D u_palette;
uniform sampler2D u_symbols;
uniform sampler2D u_source;
uniform vec4 u_tile;
uniform vec4 u_view;
uniform vec2 u_size;
uniform vec2 u_grid;      // columns and lines of the chart
uniform float u_split;    // from here to the right the carpet is shown [px]
uniform int u_left;       // what is left of it: 0 chart, 1 picture
uniform int u_samples;    // samples of a pixel in each direction
uniform float u_lines;    // every so many knots a stronger line
uniform float u_ratio;    // pixels of the screen for one of the page
in vec2 v_at;
out vec4 colour;

vec3 linear(vec3 c) { return c * c; }
vec3 coded(vec3 c) { return sqrt(c); }
uint knotAt(vec2 at) { return texelFetch(u_knots, clamp(ivec2(at), ivec2(0), ivec2(u_tile.zw) - 1), 0).r; }
vec3 yarnOf(uint knot) { return texelFetch(u_palette, ivec2(int(knot), 0), 0).rgb; }
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }

vec3 averaged() {
  vec2 step = 1.0 / u_view.zw;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < u_samples; i++) {
    for (int j = 0; j < u_samples; j++) {
      vec2 offset = (vec2(float(i), float(j)) + 0.5) / float(u_samples) - 0.5;
      sum += linear(yarnOf(knotAt(v_at + offset * step)));
    }
  }
  return coded(sum / float(u_samples * u_samples));
}

vec3 chartColour(vec3 c, vec2 within, vec2 knot, float px) {
  float ink = dot(c, vec3(0.3, 0.59, 0.11)) > 0.45 ? 0.0 : 1.0;
  if (px > 13.0 * u_ratio) {
    uint yarn = knotAt(v_at);
    vec2 cell = vec2(float(yarn & 15u), float(yarn >> 4u));
    float side = min(u_view.z, u_view.w);
    vec2 local = (within - 0.5) * u_view.zw / side + 0.5;
    float sign = texture(u_symbols, (cell + clamp(local, 0.0, 1.0)) / 16.0).r;
    float fade = clamp((px / u_ratio - 13.0) / 6.0, 0.0, 1.0);
    if (local == clamp(local, 0.0, 1.0)) c = mix(c, vec3(ink), 0.85 * sign * fade);
  }
  if (px > 5.0 * u_ratio) {
    vec2 far = min(within, 1.0 - within) * u_view.zw;
    float fade = clamp((px / u_ratio - 5.0) / 8.0, 0.0, 1.0);
    float thin = 1.0 - smoothstep(0.25, 0.75, min(far.x, far.y) / u_ratio);
    // Lines are counted from the lower left knot, as the weaver counts.
    vec2 from = vec2(knot.x + within.x, u_grid.y - knot.y - within.y);
    vec2 strong = abs(from - u_lines * floor(from / u_lines + 0.5)) * u_view.zw;
    float thick = 1.0 - smoothstep(0.75, 1.5, min(strong.x, strong.y) / u_ratio);
    c = mix(c, vec3(ink), fade * max(0.22 * thin, 0.65 * thick));
  }
  return c;
}

float lot(float at) {
  return mix(hash(vec2(floor(at), 7.0)), hash(vec2(floor(at) + 1.0, 7.0)), smoothstep(0.0, 1.0, fract(at))) - 0.5;
}

vec3 carpetColour(vec3 c, vec2 within, vec2 knot, float px) {
  float near = clamp((px / u_ratio - 2.0) / 6.0, 0.0, 1.0);
  float grain = hash(knot) - 0.5;
  // Hand-dyed lots follow each other along the carpet; pile is darker than flat yarn.
  float row = knot.y + within.y;
  c *= 1.0 + 0.07 * near * grain + 0.09 * lot(row / 11.0) + 0.05 * lot(row / 3.0 + 40.0);
  vec2 p = 2.0 * within - 1.0;
  float side = 1.0 - abs(p.x);
  // A knot shows the ends of its yarn as two tufts side by side, the nap towards the lower edge.
  float tuft = 1.0 - 0.55 * pow(abs(abs(p.x) - 0.48) / 0.52, 2.0);
  float nap = 1.04 - 0.30 * smoothstep(0.25, 1.0, p.y) - 0.16 * smoothstep(0.4, 1.0, -p.y);
  float fibre = 0.05 * sin(40.0 * p.x + 6.0 * grain + 3.0 * p.y);
  return c * mix(0.86, 1.1 * clamp(tuft, 0.0, 1.0) * nap * (1.0 + fibre) * (0.86 + 0.14 * smoothstep(0.0, 0.3, side)), near);
}

void main() {
  float px = u_view.w;
  vec2 within = fract(v_at);
  vec2 knot = u_tile.xy + floor(v_at);
  bool carpet = gl_FragCoord.x >= u_split;
  if (!carpet && u_left == 1) {
    colour = vec4(texture(u_source, (u_tile.xy + v_at) / u_grid).rgb, 1.0);
  } else {
    vec3 c = u_samples > 1 ? averaged() : yarnOf(knotAt(v_at));
    c = carpet ? carpetColour(c, within, knot, px) : chartColour(c, within, knot, px);
    colour = vec4(c, 1.0);
  }
  if (abs(gl_FragCoord.x - u_split) < u_ratio && u_split > 0.0 && u_split < u_size.x) {
    colour = vec4(mix(colour.rgb, vec3(1.0), 0.75), 1.0);
  }
}`;
