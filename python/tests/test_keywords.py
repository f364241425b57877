"""The program's options against the module's keywords: each option is a keyword, or it is said here where it is."""

import inspect
import re
import subprocess

import pytest

import sightline
from sightline import Scene
from test_answers import program

read, picture = "Scene.read()", "answers are drawn by plot(), or by other programs from points() and triangles()"
program_alone = "of the program alone"
#: What means the same for every command.
everywhere = {
    "help": "help()", "quiet": "nothing is printed", "json": "answers are objects", "certificate": "certificate()",
    "coordinates": read, "flip": read, "format": read, "svg": picture, "html": picture, "mesh": picture, "obj": picture,
    "look": picture, "up": picture, "field": picture, "shade": picture, "size": picture, "background": picture,
    "seed": "answers do not depend on it",
}  # fmt: skip
#: Of each command its function, and where its other options are.
commands = {
    "info": (Scene.info, dict.fromkeys(("threads", "budget"), "it is quick")),
    "order": (
        Scene.order,
        {
            "front-to-back": "parts[::-1]", "skip-hidden": "what is seen of them: Scene.see()", "kernel": "exact alone",
            "method": program_alone, "two-sided": "--method graph's",
        },
    ),
    "graph": (
        Scene.graph,
        {
            **dict.fromkeys(("box", "region", "eye", "ray"), "from anywhere; the rest is the program's"),
            **dict.fromkeys(("method", "arcs", "tree", "codes", "split", "two-sided"), program_alone),
            **dict.fromkeys(("pixels", "eyes", "pictures"), program_alone),
            "dot": picture,
        },
    ),
    "cutset": (
        Scene.tracker,
        {
            **dict.fromkeys(("path", "orbit", "radius", "height", "motion", "eye"), "move_to()"),
            "faces": "on_view",
            "check": "the tests do",
            **dict.fromkeys(("threads", "budget"), "a step is quick"),
            **dict.fromkeys(("decision-tree", "likelihood", "inside", "method"), program_alone),
        },
    ),
    "see": (
        Scene.see,
        {"kernel": "exact alone", "method": program_alone, "lines": "View.lines()"},
    ),
    "weak": (
        Scene.weakly_visible,
        {
            **dict.fromkeys(("from-face", "from"), "source"),
            "beside-rays": program_alone,
            **dict.fromkeys(("partition", "all-borders"), "Scene.partition()"),
            "along": "Scene.see_along()",
            **dict.fromkeys(("method", "rays", "cells", "event-edges", "surfaces"), program_alone),
            "eye": "plot(eye=)",
        },
    ),
    "render": (
        Scene.render,
        {
            "method": "centres; Picture.means() is exact",
            "kernel": "exact alone",
            **dict.fromkeys(("bits", "samples"), "of methods of the program"),
            "png": "faces, sides: arrays",
            "colours": "Picture.means(values)",
            "alpha": program_alone,
        },
    ),
    "shadow": (Scene.shadow, {"eye": picture, "volume": "Shadow.space()"}),
    "trace": (Scene.trace, {"rays": "origins, directions", "method": "doubles where they suffice"}),
    "cells": (Scene.cells, {"seal": "Cells.way_out()", "coarse": "Cells.coarse()", "out": "Cells"}),
    "pvs": (
        Scene.pvs,
        {
            "cells-too": "Cells.pairs()",
            "cells": "Cells.pvs()",
            "coarse": "Cells.coarse()",
            "show": "visible[cell]",
            "eye": picture,
            **dict.fromkeys(("out", "table"), "table()"),
            "certificates": "PotentiallyVisible.certificate()",
            **dict.fromkeys(("shard", "resume"), program_alone),
        },
    ),
    "boolean": (
        sightline.boolean,
        {
            "out": "Scene.write()",
            "repair": "none is the only one",
            **dict.fromkeys(("round", "snap", "snap-rounds"), "Scene.write() says what its format cannot hold"),
        },
    ),
    "verify": (
        Scene.verify,
        {
            **dict.fromkeys(("sample", "cell"), program_alone),
            **dict.fromkeys(("solid", "result"), "SolidCertificate.verify()"),
        },
    ),
    "generate": (sightline.generate, {"query": "Generated", "out": "Scene.write()", "second": "Generated.first"}),
}
#: Keywords that are no options: arguments of the program, and what a terminal has anyway.
of_python = {"self", "progress", "budget", "eye", "source", "start", "end", "certificate", "operation", "solids",
             "origins", "directions", "family"}  # fmt: skip


def options_of(command):
    said = subprocess.run([program, command, "--help"], check=True, capture_output=True, text=True).stdout
    return {name.replace("_", "-") for name in re.findall(r"^ {1,4}(?:-\w,)?--([\w-]+)", said, re.MULTILINE)}


def keywords_of(function):
    return {name.replace("_", "-") for name in inspect.signature(function).parameters}


@pytest.mark.parametrize("command", commands)
def test_each_option_is_a_keyword_or_is_elsewhere(command):
    if not program.is_file():
        pytest.skip("the program is not built here")
    function, elsewhere = commands[command]
    options, keywords = options_of(command), keywords_of(function)
    assert len(options) > 5
    assert keywords - of_python <= options, "keywords that are no options"
    assert set(elsewhere) <= options, "listed, and no option any more"
    assert not keywords & set(elsewhere), "listed, and a keyword"
    unknown = options - keywords - set(elsewhere) - set(everywhere)
    assert not unknown, "options that Python lacks: add a keyword, or say here where it is"


def test_each_command_has_a_function_or_is_no_question():
    if not program.is_file():
        pytest.skip("the program is not built here")
    said = subprocess.run([program, "--help"], check=True, capture_output=True, text=True).stdout
    of_program = set(re.findall(r"^  (\w+)  ", said.split("Subcommands:")[1], re.MULTILINE))
    others = {
        "bsp": "order() makes it",
        "compare": "judge() is for one's own function",
        "fuzz": "sightline.fuzz() is for one's own function",
        "judge": "sightline.judge() is for one's own function",
        "reduce": "fuzz() and judge() make scenes small",
        "merge": "of parts of tables",
        "report": "a page",
        "completion": "of shells",
        "schema": "answers are objects",
    }
    assert of_program == set(commands) | set(others) and not set(commands) & set(others)
