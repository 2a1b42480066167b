"""A STEP file (AP242, mm) while it is made: solids by name with what their features must hold.

With `step`, `step_assembly` and `step_tolerances` the only modules that import OCP.
"""

import io
from collections.abc import Mapping, Sequence

from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Message import Message, Message_Gravity
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.StepData import StepData_StepModel
from OCP.TCollection import TCollection_ExtendedString, TCollection_HAsciiString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopoDS import TopoDS_Shape
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_DocumentTool

from ilmek.errors import OutputError
from ilmek.io.step_tolerances import add_tolerances
from ilmek.part.tolerances import ToleratedFeature

TIME_STAMP = "2000-01-01T00:00:00"
"""Of every file, as in the DXF: the same content gives the same bytes."""

SETTINGS: Mapping[str, str] = {"write.step.schema": "AP242DIS", "write.step.unit": "MM"}

_METRE, _MILLIMETRE = b"SI_UNIT($,.METRE.)", b"SI_UNIT(.MILLI.,.METRE.)"
"""In a file without sizes the kernel states the unit of geometric tolerances, which are in mm as all lengths, as m."""

for _printer in Message.DefaultMessenger_s().Printers():
    _printer.SetTraceLevel(Message_Gravity.Message_Fail)  # otherwise each transfer is printed on standard output


class StepDocument:
    """A document of the kernel with a title."""

    def __init__(self, title: str) -> None:
        self._title = title
        self.document = TDocStd_Document(_words("XmlOcaf"))
        XCAFApp_Application.GetApplication_s().NewDocument(_words("MDTV-XCAF"), self.document)
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())

    def solid(self, name: str, solid: TopoDS_Shape, features: Sequence[ToleratedFeature]) -> TDF_Label:
        """A solid with its name and the tolerances of its features.

        Raises OutputError for an invalid solid, and for a feature that is not on it.
        """
        if not BRepCheck_Analyzer(solid).IsValid():
            raise OutputError(f"{name} gives no valid solid", do="check whether its outline crosses itself")
        label = self.named(self.shapes.AddShape(solid, False), name)
        add_tolerances(self.document, label, solid, features)
        return label

    def content(self) -> bytes:
        """The file. Raises OutputError where nothing can be written."""
        self.shapes.UpdateAssemblies()
        writer = STEPCAFControl_Writer()  # its constructor registers the settings below
        writer.SetDimTolMode(True)
        for name, value in SETTINGS.items():
            Interface_Static.SetCVal_s(name, value)
        written = io.BytesIO()  # the library opens only paths in UTF-8
        done = writer.Transfer(self.document)
        _with_header(writer.ChangeWriter().Model(False), self._title)
        if not done or writer.WriteStream(written) != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise OutputError(f"{self._title} cannot be written as STEP")
        return written.getvalue().replace(_METRE, _MILLIMETRE)

    @staticmethod
    def named(label: TDF_Label, name: str) -> TDF_Label:
        """A label with its name."""
        TDataStd_Name.Set_s(label, _words(name))
        return label


def _with_header(model: StepData_StepModel, title: str) -> None:
    header = APIHeaderSection_MakeHeader(model)
    header.SetName(TCollection_HAsciiString(title))
    header.SetTimeStamp(TCollection_HAsciiString(TIME_STAMP))
    header.SetAuthorValue(1, TCollection_HAsciiString("ilmek"))
    header.SetOriginatingSystem(TCollection_HAsciiString("ilmek"))


def _words(text: str) -> TCollection_ExtendedString:
    return TCollection_ExtendedString(text, True)
