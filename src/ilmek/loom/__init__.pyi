from ilmek.loom.operations import LoomSetup as LoomSetup
from ilmek.loom.programme import Programme as Programme
from ilmek.loom.programme import least_heads as least_heads
from ilmek.loom.programme import make_programme as make_programme
from ilmek.loom.programme import weaving_time as weaving_time
from ilmek.loom.times import Times as Times
