"""Motion laws by name; a new one is a file here and a line below."""

from ilmek.cams.laws import cycloidal, harmonic, modified_sine, parabolic, polynomial_345
from ilmek.cams.laws.law import REST, Law

__all__ = ["LAWS", "REST", "Law"]

LAWS: dict[str, Law] = {
    file.LAW.name: file.LAW for file in (harmonic, parabolic, cycloidal, polynomial_345, modified_sine)
}
