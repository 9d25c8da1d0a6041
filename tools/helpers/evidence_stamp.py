# SPDX-License-Identifier: Apache-2.0
"""evidence_stamp.py ROOT [FILE]: stamps figures with the date and the RTL.

Without FILE, prints {"date": today, "rtl": {module: hash}, "io": [module]}: all of rtl/, and the modules of rtl/io. Comments and blanks
do not count. With FILE, an object of docs/evidence, adds date and hashes to it. docs/evidence.md names the modules that changed since
each figure's stamp."""
import datetime
import glob
import hashlib
import json
import os
import re
import sys


def module(path):
    """Named as its file without the prefix."""
    return os.path.basename(path).rsplit(".", 1)[0].removeprefix("fastsplat_")


def rtl(root):
    """Hashes by module."""
    hashes = {}
    for path in glob.glob(f"{root}/rtl/**/*.sv*", recursive=True):
        with open(path) as file:
            text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", file.read(), flags=re.DOTALL)
        hashes[module(path)] = hashlib.sha256(" ".join(text.split()).encode()).hexdigest()[:12]
    if not hashes:
        raise SystemExit(f"evidence_stamp: no RTL found in {root}/rtl")
    return dict(sorted(hashes.items()))


def stamp(root):
    return {"date": datetime.date.today().isoformat(), "rtl": rtl(root)}


def main(root, path=None):
    if path is None:
        print(json.dumps(stamp(root) | {"io": sorted(map(module, glob.glob(f"{root}/rtl/io/*.sv")))}))
        return
    with open(path) as file:
        whole = json.load(file)
    whole.update(stamp(root))
    with open(path + ".new", "w") as file:
        json.dump(whole, file, indent=1)
        file.write("\n")
    os.replace(path + ".new", path)


if __name__ == "__main__":
    main(*sys.argv[1:])
