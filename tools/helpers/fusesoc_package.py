#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""FuseSoC generator of fastsplat_pkg: fusesoc_package.py INSTANCE.yml, called in the folder of the generated core."""
import os
import subprocess
import sys

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: fusesoc_package.py INSTANCE.yml (FuseSoC calls it)")
    with open(sys.argv[1]) as file:
        instance = yaml.safe_load(file)
    config = (instance.get("parameters") or {}).get("config")
    if not config:
        sys.exit("fusesoc_package: parameter config is missing: add a built-in name or a TOML file")
    if config.endswith(".toml"):
        config = os.path.join(instance["files_root"], config)
    tool = os.environ.get("FASTSPLAT_EMIT_PACKAGE",
                          os.path.join(HERE, os.pardir, "build", "bin", "fastsplat_emit_package"))
    if not os.path.exists(tool):
        sys.exit(f"fusesoc_package: {tool} is missing; run ./run build fastsplat_emit_package, "
                 "or name it in FASTSPLAT_EMIT_PACKAGE")
    made = subprocess.run([tool, config], capture_output=True, text=True)
    if made.returncode:
        sys.exit(made.stderr.strip())
    with open("fastsplat_pkg.sv", "w") as file:
        file.write(made.stdout)
    core = {
        "name": instance["vlnv"],
        "filesets": {"package": {"files": ["fastsplat_pkg.sv"], "file_type": "systemVerilogSource"}},
        "targets": {"default": {"filesets": ["package"]}},
    }
    with open("fastsplat_pkg.core", "w") as file:
        file.write("CAPI=2:\n" + yaml.safe_dump(core, sort_keys=False))


main()
