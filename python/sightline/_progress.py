"""Who is told how far a question is."""

import contextlib
import importlib
from typing import Any, Callable, Iterator, Optional, Union

Progress = Union[None, bool, Callable[[int, int], Any]]


@contextlib.contextmanager
def followed(progress: Progress, what: str) -> Iterator[Optional[Callable[[int, int], Any]]]:
    """What C++ calls: the callable itself, or, for True, a bar of tqdm; nothing where tqdm is not there."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        if not callable(progress):
            raise TypeError(f"progress is a {type(progress).__name__}; give a callable of (done, all), or True")
        yield progress
        return
    try:
        tqdm = importlib.import_module("tqdm.auto").tqdm
    except ImportError:
        yield None
        return
    with tqdm(desc=what) as bar:

        def tell(done: int, total: int) -> None:
            bar.total = total
            bar.update(done - bar.n)

        yield tell
