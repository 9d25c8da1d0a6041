# SPDX-License-Identifier: Apache-2.0
"""A mutant put to the proof of its module, and to no other: rtl/ with that one mistake in it, nothing chosen at run time."""
import os
import re
import shutil
import subprocess

import generate

# By module: the script, and the unit in it that is proved.
_CONTROL, _CORE, _UNITS, _BOUNDS = (f"proofs/prove_{part}.sh" for part in ("control", "core", "units", "bounds"))
_SAMPLES, _CULL, _FETCH = (f"proofs/prove_{part}.sh" for part in ("samples", "cull", "fetch"))
_SCRIPTS = {"sheet_bank": ("prove.sh", "sheet_bank"), "csr": (_UNITS, "csr"), "pixel_out": (_UNITS, "pixel_out"), "narrow": (_UNITS, "narrow"),
            "stream_check": (_CONTROL, "stream_check"), "record_rules": (_CONTROL, "stream_check"), "word_rules": (_CONTROL, "stream_check"),
            "stream_decode": (_CONTROL, "stream_decode"), "dirty_map": (_CONTROL, "dirty_map"), "compositor": (_CONTROL, "compositor"),
            "fastsplat_core": (_CORE, "core"), "slab_opacity": (_BOUNDS, "slab_opacity"), "composite_lane": (_BOUNDS, "composite_lane"),
            "overlap": (_SAMPLES, "decode_samples"), "sample_places": (_SAMPLES, "samples"),
            "cull_windows": (_CULL, "cull_windows"), "cull_map": (_CULL, "cull_map"), "cull_table": (_CULL, "cull_map"),
            "slice": (_FETCH, "slice"), "queue": (_FETCH, "queue"), "fetch": (_FETCH, "fetch")}
_MORE = {"prove.sh": ["share/fastsplat/fastsplat_fault_pkg.sv"], _CONTROL: ["short"], _CORE: ["short"], _SAMPLES: ["short"]}


def has(module: str) -> bool:
    return module in _SCRIPTS


def sources(root: str, build: str) -> list[str]:
    """All that a proof is made of, but for the mutant."""
    inside = (f"{folder}/{name}" for top in (f"{root}/rtl", f"{root}/tests/rtl") for folder, _, names in os.walk(top) for name in names)
    return [f"{build}/bin/fastsplat_emit_package", f"{root}/tests/mutants/proofs.py", *sorted(inside)]


def plant(rtl: str, out: str, mutant):
    """OUT becomes RTL with the mutant in it for good."""
    shutil.copytree(rtl, out, dirs_exist_ok=True)
    name = generate.file_of(mutant["module"])
    mutated, _ = generate.mutate(rtl, lambda module, number: number == mutant["number"], planted=True, beside=mutant["module"] in generate.BESIDE)
    text = next(text for file, text, _ in mutated if file == name)
    with open(generate.paths_of(out)[name], "w") as file:
        file.write(text)


def refutes(root: str, build: str, mutant):
    """What the proof says of it, if that is no; None if it holds. A tree of links with an rtl/ of its own is what it proves."""
    tree = f"{build}/mutants/proof_{mutant['number']}"
    shutil.rmtree(tree, ignore_errors=True)
    os.makedirs(f"{tree}/source")
    for name in ("configs", "tests", "docs"):
        os.symlink(f"{root}/{name}", f"{tree}/source/{name}")
    plant(f"{root}/rtl", f"{tree}/source/rtl", mutant)
    script, unit = _SCRIPTS[mutant["module"]]
    words = [f"{root}/tests/rtl/{script}", f"{build}/bin/fastsplat_emit_package", f"{tree}/source", f"{tree}/work"]
    if script == _FETCH:
        del words[1]  # it has no configuration
    words += [f"{build}/{word}" if "/" in word else word for word in _MORE.get(script, [])]
    ran = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "FASTSPLAT_PROVE_ONLY": unit})
    said = re.search(r"^(\w+: not (?:proved|its definition).*)$", ran.stdout, re.M)
    # A planted fault of the proof's own may lie in the mutated line: the property itself was proved before.
    if not said and ran.returncode != 0 and "nothing to break" not in ran.stdout:
        raise RuntimeError(f"{script} fails on mutant {mutant['number']} without a word on the proof: {ran.stdout[-300:]}{ran.stderr[-300:]}")
    shutil.rmtree(tree, ignore_errors=True)
    return said.group(1) if said else None
