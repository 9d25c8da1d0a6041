# SPDX-License-Identifier: Apache-2.0
"""fusesoc_core.py SOURCE BUILD FOLDER: fastsplat.core against rtl/ and the keys of CAPI2; its generator, then Verilator's lint."""
import glob
import os
import re
import subprocess
import sys

import yaml

source, build, folder = sys.argv[1:]
KEYS = {  # keys of FuseSoC's schema that such a core may have
    "": {"name", "description", "filesets", "generators", "generate", "targets"},
    "filesets": {"file_type", "files", "depend", "logical_name", "tags"},
    "generators": {"command", "interpreter", "description", "usage", "cache_type", "file_input_parameters"},
    "generate": {"generator", "parameters", "position"},
    "targets": {"filesets", "generate", "toplevel", "default_tool", "tools", "description", "parameters", "flags"},
}

with open(f"{source}/fastsplat.core") as file:
    text = file.read()
assert text.startswith("CAPI=2:\n"), "the first line is the format's"
core = yaml.safe_load(text.split("\n", 1)[1])
assert set(core) <= KEYS[""], set(core) - KEYS[""]
with open(f"{source}/CMakeLists.txt") as file:
    version = re.search(r"project\(fastsplat VERSION ([0-9.]+)", file.read())[1]
assert core["name"] == f"::fastsplat:{version}", f"{core['name']}, but CMakeLists.txt has version {version}"
for section, keys in KEYS.items():
    for name, entry in (core[section] if section else {}).items():
        assert set(entry) <= keys, (section, name, set(entry) - keys)

files = {}
for name, fileset in core["filesets"].items():
    files[name] = [file if isinstance(file, str) else next(iter(file)) for file in fileset["files"]]
    for file in files[name]:
        assert os.path.isfile(f"{source}/{file}"), f"{file} is not there"
rtl = {os.path.relpath(path, source) for path in glob.glob(f"{source}/rtl/**/*.sv*", recursive=True)}
named = {file for name in ("rtl", "top", "fetch") for file in files[name]}
assert named == rtl, named ^ rtl
includes = {next(iter(file)) for file in core["filesets"]["rtl"]["files"] if not isinstance(file, str)}
assert includes == {file for file in rtl if file.endswith(".svh")}


def generated(target, toplevel):
    """Its instances of generators, where the core is the top of a design or another core depends on it."""
    names = []
    for name in core["targets"][target].get("generate", []):
        condition = re.fullmatch(r"is_toplevel \? \((.*)\)", name)
        if not condition or toplevel:
            names.append(condition[1] if condition else name)
    assert set(names) <= set(core["generate"]), names
    return names


for name, target in core["targets"].items():
    assert set(target["filesets"]) <= set(core["filesets"])
    assert generated(name, True) == (["package"] if "rtl" in target["filesets"] else []), name
assert generated("default", False) == [], "a core of another configuration would get two packages"
for instance in core["generate"].values():
    assert instance["generator"] in core["generators"]

generator = core["generators"]["fastsplat_package"]
with open(f"{folder}/instance.yml", "w") as file:
    yaml.safe_dump({"gapi": "1.0", "files_root": source, "vlnv": "::fastsplat-package:0.1.0",
                    "parameters": core["generate"]["package"]["parameters"]}, file)
environment = dict(os.environ, FASTSPLAT_EMIT_PACKAGE=f"{build}/bin/fastsplat_emit_package")
subprocess.run([sys.executable, f"{source}/{generator['command']}", "instance.yml"], cwd=folder, env=environment, check=True)
with open(f"{folder}/fastsplat_pkg.core") as file:
    made = yaml.safe_load(file.read().split("\n", 1)[1])
assert made["name"] == "::fastsplat-package:0.1.0"
package = [f"{folder}/{file}" for file in made["filesets"]["package"]["files"]]

lint = core["targets"]["lint"]
order = package + [f"{source}/{file}" for name in lint["filesets"] for file in files[name] if file not in includes]
options = lint["tools"]["verilator"]["verilator_options"]
subprocess.run(["verilator", "--lint-only", *options, f"-I{source}/rtl", "--top-module", lint["toplevel"], *order], check=True)
print(f"[figure] core_files = {sum(map(len, files.values()))} (limit > 10)")
