/* A four-bar's position, velocity and acceleration at constant crank speed: the least that C has to do.

   Closed form without arc functions, as `by_hand` of bench_linkage.py. Sines and cosines stand in loops of their own,
   in blocks: in one expression the compiler makes one call of the two and vectorises neither. */
#include <math.h>

enum { BLOCK = 256 };

void four_bar(long n, const double *restrict angle, double g, double a, double b, double c, double w,
              double *restrict cx, double *restrict cy, double *restrict rx, double *restrict ry,
              double *restrict wb, double *restrict wc, double *restrict ab, double *restrict ac)
{
    double cosine[BLOCK], sine_[BLOCK];
    for (long start = 0; start < n; start += BLOCK) {
      const long end = start + BLOCK < n ? start + BLOCK : n;
      for (long i = start; i < end; i++) cosine[i - start] = cos(angle[i]);
      for (long i = start; i < end; i++) sine_[i - start] = sin(angle[i]);
      for (long i = start; i < end; i++) {
        double ax = a * cosine[i - start], ay = a * sine_[i - start], dx = g - ax, dy = -ay;
        double dd = 1.0 / (dx * dx + dy * dy), along = 0.5 + 0.5 * (b * b - c * c) * dd;
        double across = sqrt(b * b * dd - along * along);
        double ux = along * dx - across * dy, uy = along * dy + across * dx, vx = ux - dx, vy = uy - dy;
        double sine = 1.0 / (ux * vy - uy * vx), px = w * ay, py = -w * ax;
        double p = (vx * px + vy * py) * sine, q = (ux * px + uy * py) * sine;
        px = w * w * ax + p * p * ux - q * q * vx;
        py = w * w * ay + p * p * uy - q * q * vy;
        cx[i] = ux / b, cy[i] = uy / b, rx[i] = vx / c, ry[i] = vy / c;
        wb[i] = p, wc[i] = q;
        ab[i] = (vx * px + vy * py) * sine, ac[i] = (ux * px + uy * py) * sine;
      }
    }
}
