# SPDX-License-Identifier: Apache-2.0
"""reference_readers.py FASTSPLAT FOLDER: volumes written by nibabel and teem-unu read as in those programs, voxel by voxel.

Prints how many files agree. Exits with 1 where one does not, with 77 if a reader is missing."""
import itertools
import pathlib
import shutil
import struct
import subprocess
import sys

try:
    import nibabel
    import numpy
except ImportError:
    print("not compared: python3-nibabel is not installed")
    sys.exit(77)
if shutil.which("teem-unu") is None:
    print("not compared: teem-unu (teem-apps) is not installed")
    sys.exit(77)

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
shape = (7, 6, 5)
numbers = numpy.arange(numpy.prod(shape)).reshape(shape, order="F") * 37 % 200


def converted(path):
    """What FastSplat makes of a file: its voxels and the place of each, as nibabel reads NIfTI. Axes run to the right, to the front, upwards."""
    out = folder / "out.nii"
    run = subprocess.run([program, "volume", "convert", path, out, "--type", "f32"], capture_output=True, text=True)
    if run.returncode != 0:
        raise ValueError(run.stderr.strip())
    return nibabel.load(out)


def compare(reader, files):
    """files: path, the voxels it should have, its affine or None."""
    agree = total = 0
    for path, voxels, affine in files:
        total += 1
        try:
            ours = converted(path)
            if not numpy.array_equal(ours.get_fdata(dtype=numpy.float32), voxels.astype(numpy.float32)):
                raise ValueError("other voxels")
            if affine is not None and not numpy.allclose(ours.affine, affine, atol=1e-3):
                raise ValueError(f"another place:\n{ours.affine}\n{affine}")
            agree += 1
        except ValueError as error:
            print(f"{reader}: {path.name}: {error}")
    print(f"[figure] volumes read as {reader} reads them = {agree} of {total}")
    return agree == total and total > 0


def nifti_files():
    turned = numpy.array([[0.96, -0.28, 0], [0.28, 0.96, 0], [0, 0, 1]])
    types = ["uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64", "float32", "float64"]
    for number, (axes, signs) in enumerate(itertools.product(itertools.permutations(range(3)), itertools.product([1, -1], repeat=3))):
        matrix = numpy.zeros((3, 3))
        for axis, (world, sign) in enumerate(zip(axes, signs)):
            matrix[world, axis] = sign * (2, 3, 4)[axis]
        affine = numpy.eye(4)
        affine[:3, :3] = turned @ matrix if number % 3 == 2 else matrix
        affine[:3, 3] = (-7, 5, 11)
        name = types[number % len(types)]
        data = (numbers - (100 if name.startswith("i") else 0)).astype(name)
        kind = (nibabel.Nifti1Image, nibabel.Nifti2Image, nibabel.Nifti1Pair)[number // 2 % 3]
        image = kind(data, affine, dtype=name)
        if number % 4 == 1:
            image.header.set_slope_inter(0.5, -10)
        image.header.set_sform(affine, 1 if number % 5 else 0)
        # A qform holds no shear: for a turned grid of other spacings it is the nearest one.
        image.header.set_qform(affine, 1 if number % 5 == 0 or number % 7 == 0 else 0)
        ending = ".img" if kind is nibabel.Nifti1Pair else ".nii.gz" if number % 2 else ".nii"
        path = folder / f"n{number}{ending}"
        nibabel.save(image, path)
        read = nibabel.as_closest_canonical(nibabel.load(path))
        yield path, read.get_fdata(dtype=numpy.float32), read.affine


def nrrd_files():
    def written(name, *words):
        path = folder / name
        subprocess.run(["teem-unu", *words, "-o", path], check=True, capture_output=True)
        return path

    def of_unu(path):
        """The voxels that unu reads, x fastest."""
        run = subprocess.run(["teem-unu", "save", "-f", "nrrd", "-e", "ascii", "-i", path], check=True, capture_output=True, text=True)
        return numpy.array(run.stdout.split("\n\n", 1)[1].split(), dtype=float).reshape(shape, order="F")

    start = folder / "start.nrrd"
    header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 7 6 5\nspacings: 2 3 4\nendian: little\nencoding: raw\n\n"
    start.write_bytes(header.encode() + struct.pack(f"<{numbers.size}h", *numbers.flatten(order="F")))
    types = ["uchar", "short", "ushort", "int", "uint", "longlong", "ulonglong", "float", "double"]
    for kind, encoding in itertools.product(types, ["raw", "gzip", "bzip2", "hex", "ascii"]):
        as_type = written(f"{kind}.nrrd", "convert", "-t", kind, "-i", start)
        for ending in ("nrrd", "nhdr"):
            for order in ("little", "big") if encoding == "raw" else ("little",):
                path = written(f"{kind}-{encoding}-{order}.{ending}", "save", "-f", "nrrd", "-e", encoding, "-en", order, "-i", as_type)
                yield path, of_unu(path), None


good = [compare("nibabel", nifti_files()), compare("unu", nrrd_files())]
sys.exit(0 if all(good) else 1)
