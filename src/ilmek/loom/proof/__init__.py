"""Proof of a programme on its explicit operations. Nothing here is shared with the compiler of programmes."""

from ilmek.loom.proof.faults import FaultyPart as FaultyPart
from ilmek.loom.proof.faults import RuleFault as RuleFault
from ilmek.loom.proof.prove import MOST_FAULTS as MOST_FAULTS
from ilmek.loom.proof.prove import Proof as Proof
from ilmek.loom.proof.prove import ProvedTotals as ProvedTotals
from ilmek.loom.proof.prove import prove as prove
