"""A worker of the studio with the real tasks, that prepares nothing while no request comes: no test waits for it."""

from ilmek.jobs.studio import warm_up
from ilmek.web import worker

if __name__ == "__main__":
    warm_up.preparations = tuple
    warm_up.preparations_for = lambda *_: ()
    worker.main()
