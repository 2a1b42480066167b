"""`python -m ilmek` is `ilmek`."""

from ilmek.cli import main

if __name__ == "__main__":
    main(prog_name="ilmek")
