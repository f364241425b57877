"""The page's examples, as they stand there."""

import doctest
import re
import runpy
from pathlib import Path

import pytest

python = Path(__file__).parents[1]
page = (python / "README.md").read_text()


def test_the_sessions_say_what_the_page_says():
    result = doctest.testfile(str(python / "README.md"), module_relative=False)
    assert result.failed == 0 and result.attempted > 15


def test_from_a_mesh_to_a_picture_of_what_a_window_sees(tmp_path, monkeypatch, capsys):
    pytest.importorskip("matplotlib")
    script = (python / "examples" / "window.py").read_text()
    assert re.search(r"```python\n(from .*?)```", page, re.S)[1] in script
    assert len([line for line in script.splitlines() if line.strip()]) <= 11  # with its title
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(python / "examples" / "window.py"))
    assert f"prints `{capsys.readouterr().out.strip()}`" in page
    assert (tmp_path / "window.png").stat().st_size > 10000


def test_links_lead_somewhere():
    for link in re.findall(r"\]\(([^)#]+)\)", page):
        assert (python / link).exists(), link
