"""Modified trapezoid: a trapezoid of acceleration with its corners rounded by quarter sine waves.

    (b, c, d) = (1/4, 1/2, 1/4) of the SCCA family,   Ca = 8 pi / (pi + 2)  [Norton, Cam Design and Manufacturing, 3]

It has the least acceleration of the laws that join a dwell without a jump. The acceleration is continuous at all zone
borders: u = 1/8, 3/8, 5/8 and 7/8.
"""

from ilmek.cams.laws.law import NONE
from ilmek.cams.laws.scca import family

LAW = family("modified-trapezoid", 0.25, 0.5, 0.25, NONE)
