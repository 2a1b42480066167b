/** How fine pictures are drawn while they follow one another: coarser where the computer would fall behind. */

/** Shares of the pixels across and down. */
const LEVELS = [1, 0.7, 0.5, 0.35] as const;

/** Pictures that were wanted so soon after the one before are a motion [ms]. */
const SOON = 120;

/** Time between two pictures of a motion above which the next ones are coarser, and below which finer [ms]. */
const SLOW = 42;
const QUICK = 18;

/** Pictures in turn that must be quick before the next ones are finer. */
const PATIENCE = 20;

export class Pace {
  private level = 0;
  private drawnAt = Number.NEGATIVE_INFINITY;
  private moving = false;
  private quick = 0;

  /** A picture is wanted at a time [ms]. */
  wanted(now: number): void {
    this.moving = now - this.drawnAt < SOON;
  }

  /** A picture is drawn at a time [ms]: the share of its pixels across and down. */
  drawn(now: number): number {
    if (this.moving) this.judge(now - this.drawnAt);
    this.drawnAt = now;
    return this.moving ? (LEVELS[this.level] ?? 1) : 1;
  }

  private judge(interval: number): void {
    this.quick = interval < QUICK ? this.quick + 1 : 0;
    if (interval > SLOW) this.level = Math.min(this.level + 1, LEVELS.length - 1);
    else if (this.quick >= PATIENCE) {
      this.level = Math.max(this.level - 1, 0);
      this.quick = 0;
    }
  }
}
