"""Pages of the documentation, executed as a reader would follow them: block by block, in a fresh folder.

    `press.toml`:       a line before a block that ends with a file's name and a colon: the block is that file
    ```sh               commands. Each must end with exit code 0, or with that of its comment: `# exit code 3`
    ```console          `$ command`, and below it what it prints
    ```text             what the commands, or the Python block, before it print; `…` stands for what is left out
    ```json             the same as JSON; `"…"` stands for any value, the key "…" for further keys
    ```python           executed, with the names of the blocks before; `>>>` examples are doctests, also outside fences
    <!-- not run: WHY -->   before a block that no test can run

Commands of `ilmek` run in this process. `ilmek studio`, `ilmek serve` and a command whose comment has the words "in a
terminal of its own" run beside the page and are ended behind it.
"""

from executed_pages.blocks import Block, page_blocks
from executed_pages.execution import PageError, execute

__all__ = ["Block", "PageError", "execute", "page_blocks"]
