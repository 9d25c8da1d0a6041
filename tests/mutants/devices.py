# SPDX-License-Identifier: Apache-2.0
"""The devices that mutants run on, in their order, and which modules of rtl/ each of them has: a mutant of a module that a device is built
without is not tried there, nor is a program built for it."""
import glob
import os
import re
import subprocess
import tempfile

import generate

_CORNER, _FAULTS, _PRODUCT = "tests/mutants/{}.toml", "configs/faults/{}.toml", "configs/{}.toml"
# The smallest device, for all mutants. Then, for the survivors: one that rounds more and has more sets, one that composites every sample, the pixel
# stage's lane alone and density devices (which differ most from the first ones), devices that cull by blocks and by pixels, three more corners, and the
# smallest product.
_PLACES = {"corners": _CORNER, "mustfail": _FAULTS, "westover": _FAULTS, "density_lane": "tests/mutants/densities.toml", "post": _FAULTS, "densities": _CORNER, "density_rows": _CORNER,
           "cull": _FAULTS, "cull_pixel": _CORNER, "cull_samples": _CORNER, "ties": _CORNER, "halves": _CORNER, "truncating": _CORNER, "tiny": _PRODUCT}
_TOPS = {"density_lane": "fastsplat_classify_lane"}  # of the others the device as it ships
# Devices that are like one before but for one thing are for the modules (what their names begin with) that have to do with it: one row of blocks and
# eight slices; two rows, one slice and many radius sets; a map of pixels; samples beside culling; the rounding of centres.
_ONLY = {"densities": ("classify", "densit", "compositor", "dirty_map", "ellipse", "pixel_out"),
         "density_rows": ("density_ring", "stream_check"), "cull_samples": ("fastsplat_core", "stream_decode"),
         "cull_pixel": ("cull", "compositor", "fastsplat_core", "stream_decode"),
         "ties": ("snap", "narrow"), "halves": ("snap", "narrow"), "truncating": ("snap", "narrow")}
# The same in every device: what lives on the first is tried over tests (mutate.TESTS).
_ALIKE = {"top", "slice"}
FIRST = "corners"  # its program holds all mutants, and is the same for every run


class Device:
    def __init__(self, root: str, build: str, name: str):
        self.name, self.config = name, f"{root}/{_PLACES[name].format(name)}"
        self.modules = _modules_of(root, build, self.config, _TOPS.get(name, "fastsplat_dut"))
        self.modules = {module for module in self.modules if module.startswith(_ONLY.get(name, ""))}
        if name != FIRST:
            self.modules -= _ALIKE


def devices(root: str, build: str) -> list[Device]:
    return [Device(root, build, name) for name in _PLACES]


def _modules_of(root: str, build: str, config: str, top: str) -> set[str]:
    """What Verilator finds below the top once generate conditions are decided; the narrowing is everywhere."""
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/fastsplat_pkg.sv", "w") as file:
            subprocess.run([f"{build}/bin/fastsplat_emit_package", config], stdout=file, check=True)
        rtl = sorted(path for name, path in generate.paths_of(f"{root}/rtl").items() if name.endswith(".sv"))
        rtl += sorted(glob.glob(f"{root}/testbench/module/*.sv"))
        subprocess.run(["verilator", "--xml-only", "--xml-output", f"{folder}/tree.xml", "--Mdir", folder, "-Wno-lint", "-Wno-fatal", "--top-module",
                        top, f"-I{root}/rtl", f"{folder}/fastsplat_pkg.sv", *rtl], check=True)
        with open(f"{folder}/tree.xml") as file:
            found = set(re.findall(r'<module [^>]*origName="(\w+)"', file.read()))
    if top not in found:
        raise RuntimeError(f"{config}: Verilator tells no modules")
    return {generate.module_of(name) for name in found} | {"narrow"}
