"""The API: every request, the function of `jobs` that answers it, and what it may cost.

A function is given by its name, so that the server imports no engineering: the worker process that answers imports it.
It takes one record, the request, and a `Context`, and returns a record, which is sent as JSON, or a `Binary`. Types of
requests and answers are dataclasses; the schema of the API and the types of the client are derived from them
(`make client`), and so is the table of the manual.
"""

from dataclasses import dataclass
from functools import partial

from ilmek.jobs.studio.answers import PACKED

SECOND = 1.0
HOUR = 3600.0

FIRST = "carpet"
"""Affinity of the view that opens first."""

PICTURE_TYPES = (
    *(
        f"image/{kind}"
        for kind in ("png", "jpeg", "gif", "bmp", "tiff", "webp", "avif", "jp2", "x-pcx", "vnd.zbrush.pcx")
    ),
    *("text/xml", "application/xml", "application/octet-stream"),
)
"""Media types of an upload, as browsers state them by the file's name; the type is checked by the content."""


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One request of the API.

    method    GET, DELETE: the request is made of the path and the query; POST, PUT: of the path and the JSON body
    path      below /api; a part in braces is a field of the request
    function  "module:name" below ilmek.jobs
    limit     longest time of an answer by the clock [s], also on a busy computer; a worker that takes longer is ended
    affinity  requests of one name are answered by one worker where it is free: it keeps what the one before read
    work      True: the answer is the number of a work that goes on (202); its progress and end come by events
    upload    media types of a body that is no JSON; it becomes the field `content` (bytes) of the request, whose other
              fields come from the path and the query
    answer    media type of an answer that is no record: packed arrays, a file, JSON as the command line writes it
    records   names of further records in the function's module that a client receives: what the work shows before its
              end, and the JSON before packed arrays
    """

    method: str
    path: str
    function: str
    summary: str
    limit: float = 300 * SECOND
    affinity: str = ""
    work: bool = False
    upload: tuple[str, ...] = ()
    answer: str = ""
    records: tuple[str, ...] = ()

    @property
    def has_body(self) -> bool:
        """Whether a request has a body."""
        return self.method not in ("GET", "DELETE")


_get, _post = partial(Endpoint, "GET"), partial(Endpoint, "POST")

ENDPOINTS: tuple[Endpoint, ...] = (
    _get("/machines", "studio.machine.tasks:list_of_machines", "The machines of the catalogue."),
    _get("/machines/{name}", "studio.machine.tasks:form", "The declared parameters of a machine."),
    _post(
        "/machines/{name}/design",
        "studio.machine.tasks:design",
        "Design a machine: the JSON of `ilmek design NAME --json -`.",
        affinity="machine",
        answer="application/json",
    ),
    _post("/machines/{name}/reading", "studio.machine.tasks:reading", "Read one typed value of a parameter."),
    _post(
        "/machines/{name}/view",
        "studio.machine.view:view",
        "Design a machine: verdict, checks and results with their texts, without tables and figures.",
        affinity="machine",
    ),
    _post(
        "/machines/{name}/space",
        "studio.machine.view:in_space",
        "The same with the parts of the machine against each other in space.",
        affinity="nearest",
    ),
    _post(
        "/machines/{name}/nearest",
        "studio.machine.view:nearest",
        "The nearest carpets that a loom could weave, where it cannot weave what is required.",
        affinity="nearest",
    ),
    _post(
        "/machines/{name}/figures",
        "studio.machine.figures:figures",
        "Figures of a design by name, as data; and the names of all that there are.",
        affinity="machine",
    ),
    _post(
        "/machines/{name}/tables",
        "studio.machine.figures:tables",
        "The tables of a design.",
        affinity="machine",
    ),
    _post(
        "/machines/{name}/sensitivities",
        "studio.machine.sensitivities:sensitivities",
        "What each parameter does to each check, by small steps; each is sent as soon as it is known.",
        limit=HOUR,
        affinity="sensitivities",
        work=True,
    ),
    _post(
        "/machines/{name}/comparison",
        "studio.machine.comparison:comparison",
        "What differs between two settings of a machine: parameters, results, checks.",
        affinity="machine",
    ),
    _post(
        "/study/numbers",
        "studio.study:numbers",
        "What can vary of a machine or a mechanism, with a range about its present value; and its results.",
        affinity="sensitivities",
    ),
    _post(
        "/study",
        "studio.study:studied",
        "Designs of a machine or a mechanism over ranges, as figures: all designs, each result over each variable.",
        limit=HOUR,
        work=True,
    ),
    _post(
        "/synthesis/candidates",
        "studio.synthesis.tasks:candidates",
        "The four-bars for a task, ranked, with reasons for those left out; `quick` while a point is dragged.",
        affinity="synthesis",
    ),
    _post(
        "/synthesis/search",
        "studio.synthesis.tasks:candidates",
        "The same as work, with progress: the full search.",
        limit=HOUR,
        work=True,
    ),
    _post(
        "/synthesis/mechanism",
        "studio.synthesis.tasks:mechanism",
        "A four-bar of a synthesis as a mechanism file.",
        affinity="synthesis",
    ),
    _post(
        "/loom/scene",
        "studio.loom.scene:scene",
        "A loom of the project in space: parts, motions, warps, yarns, carpet (packed).",
        affinity="loom",
        answer=PACKED,
    ),
    _post(
        "/loom/space",
        "studio.loom.scene:in_space",
        "What a scene leaves open: the parts of the loom against each other in space (packed).",
        affinity="loom",
        answer=PACKED,
    ),
    _post(
        "/loom/plate",
        "studio.loom.scene:plate",
        "The drawing of a plate of a loom of the project.",
        affinity="loom",
    ),
    _post(
        "/loom/glb",
        "studio.loom.scene:glb",
        "A loom of the project as GLB, in motion.",
        affinity="loom",
        answer="model/gltf-binary",
    ),
    _post(
        "/loom/run",
        "studio.loom.run:run",
        "Weave the carpet of a recipe on the twin; news of the run ten times a second.",
        limit=24 * HOUR,
        work=True,
    ),
    _post(
        "/loom/command",
        "studio.loom.run:command",
        "A command to the run: hold, resume, stop, acknowledge, yes, no.",
    ),
    _get("/project", "studio.project.tasks:project", "The files of the project, each with its first error."),
    _get(
        "/project/files/{path:path}",
        "studio.project.tasks:read_file",
        "A text file of the project.",
        affinity=FIRST,  # its check needs what the chart needs: imported once
    ),
    Endpoint(
        "PUT",
        "/project/files/{path:path}",
        "studio.project.tasks:save_file",
        "Save a text file, where nobody changed it since; what is not changed is kept, also comments.",
    ),
    _post("/project/undo", "studio.project.tasks:undo", "Bring back the state of a file before the current one."),
    _post("/project/redo", "studio.project.tasks:redo", "Bring back the state of a file that was undone last."),
    _post("/project/new", "studio.project.tasks:new_file", "A new text file, or a copy of one."),
    _post("/project/rename", "studio.project.tasks:rename_file", "Rename a text file, with its history."),
    _post("/project/delete", "studio.project.tasks:delete_file", "Delete a text file; undo brings it back."),
    _post(
        "/project/pictures",
        "studio.project.pictures:upload_picture",
        "Put a picture, or a knot chart in a format that is read, into the project.",
        upload=PICTURE_TYPES,
    ),
    _post("/project/pictures/delete", "studio.project.pictures:delete_picture", "Delete a picture."),
    _post("/project/products", "studio.project.products:products", "What can be written of a file, with commands."),
    _post(
        "/project/write",
        "studio.outputs:write_product",
        "Write a product of a file into out/, as the command line does.",
        limit=HOUR,
        work=True,
    ),
    _get("/project/out", "studio.project.out:written", "What was written into out/, the newest first."),
    _get(
        "/project/archive/{path:path}",
        "studio.project.out:archive",
        "A folder in out/ as ZIP.",
        answer="application/zip",
    ),
    _post("/project/out/delete", "studio.project.out:delete_written", "Delete a file or folder of out/."),
    _post("/commands", "studio.commands:shown_command", "A state as its command line and as Python."),
    _post(
        "/cyclogram/view",
        "studio.cyclogram.tasks:view",
        "A cyclogram: curves of its tracks, relations and exclusions with their margins, checks (packed).",
        affinity="cyclogram",
        records=("CyclogramView",),
        answer=PACKED,
    ),
    _post(
        "/cyclogram/solve",
        "studio.cyclogram.tasks:solved",
        "Least acceleration or shortest turn of a cyclogram, and what binds.",
        limit=HOUR,
        work=True,
    ),
    _post(
        "/cyclogram/machine",
        "studio.cyclogram.tasks:of_machine",
        "The cyclograms of a machine of the catalogue, as files' data.",
        affinity="machine",
    ),
    _post(
        "/mechanism",
        "studio.linkage.tasks:mechanism",
        "A mechanism from its file's data: structure, what is missing, motion; also while a joint is dragged.",
        affinity="linkage",
    ),
    _post(
        "/mechanism/foreign",
        "studio.linkage.foreign:foreign_mechanism",
        "A mechanism of another program's file as the text of a mechanism file.",
        affinity="linkage",
        upload=("application/octet-stream",),
    ),
    _post(
        "/mechanism/quality",
        "studio.linkage.quality:quality",
        "Circuits, mobility, coupler curves, least transmission angles and the checks of `ilmek mechanism`.",
        affinity="linkage-quality",
    ),
    _post(
        "/carpet/chart",
        "studio.carpet.tasks:chart",
        "The chart of a recipe, saved or not: yarns, checks, cost; then one byte a knot (packed).",
        limit=10 * 60 * SECOND,
        affinity="carpet",
        records=("ChartAnswer",),
        answer=PACKED,
    ),
    _post(
        "/carpet/row",
        "studio.carpet.tasks:row",
        "A row of the chart of a recipe to weave by, in both directions.",
        limit=10 * 60 * SECOND,
        affinity="carpet",
    ),
    _post(
        "/carpet/specks",
        "studio.carpet.tasks:specks",
        "The small patches of a chart outside of patterns, their knots and the yarns around them (packed).",
        limit=10 * 60 * SECOND,
        affinity="carpet",
        records=("Specks",),
        answer=PACKED,
    ),
    _post(
        "/carpet/proposal",
        "studio.carpet.tasks:proposal",
        "The shades that suit the picture of a recipe best.",
        limit=10 * 60 * SECOND,
        affinity="carpet",
    ),
    _post(
        "/carpet/corners",
        "studio.carpet.tasks:corners",
        "The corners of a carpet photographed at an angle.",
        affinity="carpet picture",
    ),
    _post(
        "/carpet/picture",
        "studio.carpet.tasks:picture",
        "A picture of the project as it is read, made small (packed).",
        affinity="carpet picture",
        records=("PictureAbout",),
        answer=PACKED,
    ),
)
