# SPDX-License-Identifier: Apache-2.0
"""The integer device model and the passive checker in Python: libfastsplat by ctypes, NumPy arrays in and out.

    import fastsplat
    model = fastsplat.Model(fastsplat.Config("tiny"))
    model.feed(fastsplat.read_stream("scene.fss"))
    model.finish()
    for tile in model.tiles():
        print(tile.number, tile.rgba.shape, tile.rgba.dtype)   # (height, width, 4) uint32

One file; needs NumPy. The library is $FASTSPLAT_LIBRARY, else the one installed beside this file, else the loader's.
Refusals of the library raise fastsplat.Error with status and text (docs/capi.md).
"""
import collections
import ctypes
import os

import numpy as np

OK, NONE, FAILED, USAGE, INPUT = 0, -1, 1, 2, 3
WHOLE, SUBSET = 0, 1
BEAT_WORDS = 8
STREAM_VERSION = 2
TAPS = ("snap", "footprint", "sheet", "composite", "pixel")
_DETECTORS = TAPS + ("tiles", "counters", "cycles", "verdicts")
_VERDICTS = ("pass", "mismatch", "nothing compared", "open")
_API_MAJOR = 3
_STREAM_MAGIC = 0x31535346


class Error(Exception):
    """A refusal: `status` as in fastsplat.h."""

    def __init__(self, status, text):
        super().__init__(text)
        self.status = status


Tap = collections.namedtuple("Tap", "kind tile sheet tag x y words")  # words: uint32
Tile = collections.namedtuple("Tile", "number x y rgba")  # rgba: uint32, (height, width, 4)
Report = collections.namedtuple("Report", "verdict detector comparisons mismatches by_tap cycles")


class _Tap(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_size_t), ("tap", ctypes.c_uint32), ("tile", ctypes.c_uint32),
                ("sheet", ctypes.c_uint32), ("tag", ctypes.c_uint32), ("x", ctypes.c_int32), ("y", ctypes.c_int32),
                ("words", ctypes.c_uint32), ("payload", ctypes.POINTER(ctypes.c_uint32))]


class _Tile(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_size_t), ("tile", ctypes.c_uint32), ("x", ctypes.c_int32),
                ("y", ctypes.c_int32), ("width", ctypes.c_uint32), ("height", ctypes.c_uint32),
                ("words", ctypes.c_size_t), ("rgba", ctypes.POINTER(ctypes.c_uint32))]


class _Options(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_size_t), ("scope", ctypes.c_uint32), ("stop_after", ctypes.c_uint64),
                ("input_pattern", ctypes.c_char_p), ("output_pattern", ctypes.c_char_p), ("seed", ctypes.c_uint64),
                ("verdicts", ctypes.c_int32)]


class _Shown(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_size_t), ("port", ctypes.c_uint32), ("given", ctypes.c_uint32),
                ("keep", ctypes.c_uint32), ("tile", ctypes.c_uint32), ("cycle", ctypes.c_uint64), ("tag", ctypes.c_uint32),
                ("x", ctypes.c_uint32), ("y", ctypes.c_uint32), ("mx", ctypes.c_uint32), ("my", ctypes.c_uint32),
                ("block", ctypes.c_uint32), ("last", ctypes.c_int32), ("cut", ctypes.c_int32),
                ("hidden", ctypes.c_int32), ("word_count", ctypes.c_size_t), ("words", ctypes.c_void_p)]


class _Report(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_size_t), ("verdict", ctypes.c_int32), ("detector", ctypes.c_int32),
                ("comparisons", ctypes.c_uint64), ("mismatches", ctypes.c_uint64), ("by_tap", ctypes.c_uint64 * 5),
                ("cycles_compared", ctypes.c_int32), ("cycles_device", ctypes.c_uint64),
                ("cycles_model", ctypes.c_uint64)]


def _load():
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[os.pardir] * 3)
    places = [os.path.join(beside, lib, "libfastsplat.so.3") for lib in ("lib", "lib64", "lib/" + os.uname().machine + "-linux-gnu")]
    found = [place for place in places if os.path.exists(place)] + ["libfastsplat.so.3"]
    chosen = os.environ.get("FASTSPLAT_LIBRARY") or found[0]  # a named library is never replaced by another
    try:
        library = ctypes.CDLL(chosen)
    except OSError as error:
        raise ImportError(f"{error}; set FASTSPLAT_LIBRARY to libfastsplat.so.3") from None
    for name in ("fastsplat_version", "fastsplat_last_error", "fastsplat_checker_first_mismatch",
                 "fastsplat_checker_summary"):
        getattr(library, name).restype = ctypes.c_char_p
    library.fastsplat_api_version.restype = ctypes.c_uint32
    if library.fastsplat_api_version() >> 16 != _API_MAJOR:
        raise ImportError(f"{chosen}: its interface version differs from that of this fastsplat.py")
    return library


_library = _load()


def _call(name, *arguments):
    """Returns the status; raises Error for a refusal or a failed verdict."""
    status = getattr(_library, name)(*arguments)
    if status > 0:
        raise Error(status, _library.fastsplat_last_error().decode())
    return status


def version():
    return _library.fastsplat_version().decode()


def config_names():
    return _names("fastsplat_config_name")


def counter_names():
    return _names("fastsplat_counter_name")


def _names(function):
    names, out = [], ctypes.c_char_p()
    while _call(function, ctypes.c_size_t(len(names)), ctypes.byref(out)) == OK:
        names.append(out.value.decode())
    return names


def read_stream(path):
    """The beats of a recorded stream (.fss): uint32, (beats, BEAT_WORDS). Its contents are checked when they are fed."""
    octets = np.fromfile(path, dtype=np.uint8)
    words = octets[: octets.size // 4 * 4].view("<u4")
    if words.size > 1 and words[1] == _STREAM_MAGIC and words[0] >> 16 != STREAM_VERSION:
        raise ValueError(f"{path}: stream version {words[0] >> 16}, this library reads version {STREAM_VERSION}: record it again")
    if octets.size == 0 or octets.size % (4 * BEAT_WORDS):
        raise ValueError(f"{path}: {octets.size} bytes are not a multiple of the beat size, {4 * BEAT_WORDS}")
    return words.reshape(-1, BEAT_WORDS)


def _whole(what, values, dtype):
    """`values` unchanged: numbers outside `dtype` are refused, not truncated."""
    values = np.asarray(values)
    if values.size and values.dtype.kind not in "ui":
        raise ValueError(f"{what}: expected whole numbers, got {values.dtype}")
    if values.size and (values.min() < 0 or int(values.max()) > np.iinfo(dtype).max):
        raise ValueError(f"{what}: expected 0 to {np.iinfo(dtype).max}, got {values.min()} to {values.max()}")
    return np.ascontiguousarray(values, dtype=dtype)


def _number(what, value, dtype):
    """The same for one number, which ctypes would truncate."""
    limits = np.iinfo(dtype)
    if not isinstance(value, (int, np.integer, np.bool_)) or not limits.min <= value <= limits.max:
        raise ValueError(f"{what}: expected {limits.min} to {limits.max}, got {value!r}")
    return int(value)


def _text(what, value):
    """Text for C, without a NUL, where it would end."""
    if "\0" in value:
        raise ValueError(f"{what}: {value!r} contains a NUL")
    return value.encode()


def _place(what, choices, name):
    if name not in choices:
        raise ValueError(f"unknown {what} {name!r}; expected one of {', '.join(choices)}")
    return choices.index(name)


def _beats(beats):
    beats = _whole("beats", beats, np.uint32)
    if beats.ndim == 1 and beats.size == BEAT_WORDS:
        beats = beats.reshape(1, BEAT_WORDS)
    if beats.ndim != 2 or beats.shape[1] != BEAT_WORDS:
        raise ValueError(f"beats: expected the shape (n, {BEAT_WORDS}), got {beats.shape}")
    return beats


class _Handle:
    _destroy = ""

    def __init__(self):
        self._pointer = ctypes.c_void_p()

    def __del__(self):
        if getattr(self, "_pointer", None):
            getattr(_library, self._destroy)(self._pointer)
            self._pointer = None


class Config(_Handle):
    """A built-in configuration by name, or one from a TOML file (path=) or text (text=)."""
    _destroy = "fastsplat_config_destroy"

    def __init__(self, name=None, *, path=None, text=None):
        super().__init__()
        if (name is not None) + (path is not None) + (text is not None) != 1:
            raise ValueError("expected exactly one of name, path and text")
        out = ctypes.byref(self._pointer)
        if text is not None:
            data = text.encode()
            _call("fastsplat_config_text", data, ctypes.c_size_t(len(data)), None, out)
        elif path is not None:
            _call("fastsplat_config_file", os.fsencode(path), out)
        else:
            _call("fastsplat_config_named", _text("name", name), out)

    @property
    def hash(self):
        out = ctypes.c_uint64()
        _call("fastsplat_config_hash", self._pointer, ctypes.byref(out))
        return out.value

    def __getitem__(self, key):
        out = ctypes.c_int64()
        _call("fastsplat_config_value", self._pointer, _text("key", key), ctypes.byref(out))
        return out.value


class Model(_Handle):
    """Beats in; taps (those of `taps`), tiles and counters out."""
    _destroy = "fastsplat_model_destroy"

    def __init__(self, config, taps=TAPS, scope=WHOLE):
        super().__init__()
        mask = sum(1 << _place("tap", TAPS, name) for name in set(taps))
        _call("fastsplat_model_create", config._pointer, ctypes.c_uint32(scope), ctypes.c_uint32(mask),
              ctypes.byref(self._pointer))

    def feed(self, beats):
        beats = _beats(beats)
        _call("fastsplat_model_feed", self._pointer, beats.ctypes.data_as(ctypes.c_void_p),
              ctypes.c_size_t(len(beats)))

    def finish(self):
        _call("fastsplat_model_finish", self._pointer)

    def reset(self):
        _call("fastsplat_model_reset", self._pointer)

    def taps(self):
        """Takes the waiting records, in the model's order."""
        record = _Tap(struct_size=ctypes.sizeof(_Tap))
        while _call("fastsplat_model_next_tap", self._pointer, ctypes.byref(record)) == OK:
            words = np.ctypeslib.as_array(record.payload, (record.words,)).copy()
            yield Tap(TAPS[record.tap], record.tile, record.sheet, record.tag, record.x, record.y, words)

    def tiles(self):
        """Takes the finished tiles."""
        tile = _Tile(struct_size=ctypes.sizeof(_Tile))
        while _call("fastsplat_model_next_tile", self._pointer, ctypes.byref(tile)) == OK:
            rgba = np.ctypeslib.as_array(tile.rgba, (tile.height, tile.width, 4)).copy()
            yield Tile(tile.tile, tile.x, tile.y, rgba)

    @property
    def counters(self):
        names = counter_names()[:16]
        values = np.zeros(len(names), dtype=np.uint64)
        _call("fastsplat_model_counters", self._pointer, values.ctypes.data_as(ctypes.c_void_p),
              ctypes.c_size_t(values.size))
        return dict(zip(names, values.tolist()))


class Checker(_Handle):
    """Receives what a device took and showed; see fastsplat.h for the order."""
    _destroy = "fastsplat_checker_destroy"
    PORTS = ("snap", "sheet", "window", "composite", "sheet_done", "pixels", "verdict")
    _GIVEN = {"keep": 1, "tile": 2}
    _FIELDS = [name for name, _ in _Shown._fields_ if name not in ("struct_size", "port", "given", "word_count", "words")]

    def __init__(self, config, scope=WHOLE, stop_after=0, input_pattern="always", output_pattern="always", seed=0,
                 verdicts=False):
        super().__init__()
        options = _Options(ctypes.sizeof(_Options), scope, _number("stop_after", stop_after, np.uint64),
                           _text("input_pattern", input_pattern), _text("output_pattern", output_pattern),
                           _number("seed", seed, np.uint64), verdicts)
        _call("fastsplat_checker_create", config._pointer, ctypes.byref(options), ctypes.byref(self._pointer))

    def start(self, first_beat):
        _call("fastsplat_checker_start", self._pointer, ctypes.c_uint64(_number("first_beat", first_beat, np.uint64)))

    def took(self, beats):
        beats = _beats(beats)
        _call("fastsplat_checker_took", self._pointer, beats.ctypes.data_as(ctypes.c_void_p),
              ctypes.c_size_t(len(beats)))

    def showed(self, port, cycle, words=(), **fields):
        """`fields`: the fields of fastsplat_shown that the port has; keep and tile are compared if given."""
        words = _whole("words", words, np.uint32)
        for name, value in dict(fields, cycle=cycle).items():
            if name not in self._FIELDS:
                raise TypeError(f"showed: unknown field {name}; expected one of {', '.join(self._FIELDS)}")
            _number(name, value, np.uint64 if name == "cycle" else np.uint32)
        given = sum(bit for name, bit in self._GIVEN.items() if name in fields)
        shown = _Shown(struct_size=ctypes.sizeof(_Shown), port=_place("port", self.PORTS, port), given=given, cycle=cycle,
                       word_count=words.size, words=words.ctypes.data, **fields)
        _call("fastsplat_checker_showed", self._pointer, ctypes.byref(shown))

    def finish(self, counters=()):
        """True is a pass; otherwise see report() and first_mismatch()."""
        values = _whole("counters", counters, np.uint64)
        try:
            _call("fastsplat_checker_finish", self._pointer, values.ctypes.data_as(ctypes.c_void_p),
                  ctypes.c_size_t(values.size))
        except Error as error:
            if error.status != FAILED:
                raise
            return False
        return True

    def report(self):
        out = _Report(struct_size=ctypes.sizeof(_Report))
        _call("fastsplat_checker_report", self._pointer, ctypes.byref(out))
        return Report(_VERDICTS[out.verdict], _DETECTORS[out.detector] if out.detector >= 0 else None, out.comparisons,
                      out.mismatches, dict(zip(TAPS, out.by_tap)),
                      (out.cycles_device, out.cycles_model) if out.cycles_compared else None)

    def first_mismatch(self):
        return _library.fastsplat_checker_first_mismatch(self._pointer).decode()
