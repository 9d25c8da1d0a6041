// The C interface of libfastsplat: the integer device model and the passive checker, for benches in any language.
// docs/capi.md is its page: the contract, an example, every status. Version 3.0; C99 and C++.
//
// Every function that can fail returns a fastsplat_status; fastsplat_last_error() then has one line of text. A call
// that fails changes nothing but that text, and no C++ exception leaves the library.
// Handles are opaque. Who created one destroys it; destroying NULL does nothing, anything that is no live handle of the
// right kind is refused. A handle keeps nothing of the handles and the memory it was made from.
// Different handles may be used by different threads at the same time; one handle only by one thread at a time, but a
// configuration, which never changes, by any number.
// Structures begin with struct_size, which the caller sets to sizeof of the one he was compiled with: a later library
// fills, and reads, no more than that.
#pragma once

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define FASTSPLAT_API __attribute__((visibility("default")))
#else
#define FASTSPLAT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- version and errors

#define FASTSPLAT_API_MAJOR 3
#define FASTSPLAT_API_MINOR 0

/// Of the library that runs: major << 16 | minor. A program runs with its own major and any minor from its own on.
FASTSPLAT_API uint32_t fastsplat_api_version(void);
/// The program's version, "0.1.0"; never NULL.
FASTSPLAT_API const char* fastsplat_version(void);

/// As the exit codes of the command line where both have one.
typedef int32_t fastsplat_status;
enum {
  FASTSPLAT_NONE = -1,       ///< nothing to take now; no error
  FASTSPLAT_OK = 0,          ///<
  FASTSPLAT_FAILED = 1,      ///< the device under test is wrong, or nothing of it was compared
  FASTSPLAT_USAGE = 2,       ///< an argument makes no sense, or the call comes out of order
  FASTSPLAT_INPUT = 3,       ///< a configuration or a stream breaks its rules
  FASTSPLAT_INTERNAL = 70,   ///< a fault of the library
  FASTSPLAT_NO_MEMORY = 71,  ///< the system gave no more
};

/// What the last failing call on this thread was about, in one line; "" before any. Valid until the next failing call
/// on this thread; never NULL.
FASTSPLAT_API const char* fastsplat_last_error(void);

// ---- configurations

typedef struct fastsplat_config fastsplat_config;

/// A built-in one, "tiny".
FASTSPLAT_API fastsplat_status fastsplat_config_named(const char* name, fastsplat_config** out);
/// From TOML text of `bytes` bytes; messages name it `where` (NULL: "configuration").
FASTSPLAT_API fastsplat_status fastsplat_config_text(const char* toml, size_t bytes, const char* where,
                                                     fastsplat_config** out);
/// From a TOML file.
FASTSPLAT_API fastsplat_status fastsplat_config_file(const char* path, fastsplat_config** out);
FASTSPLAT_API fastsplat_status fastsplat_config_destroy(fastsplat_config* config);

/// The built-in names: name `index`, or FASTSPLAT_NONE behind the last. The text lives as long as the library.
FASTSPLAT_API fastsplat_status fastsplat_config_name(size_t index, const char** out);
/// The 64 bits that begin_frame and the device's registers carry.
FASTSPLAT_API fastsplat_status fastsplat_config_hash(const fastsplat_config* config, uint64_t* out);
/// The number behind a key of the file, "array.lanes"; of a key of words the word's place in its list.
FASTSPLAT_API fastsplat_status fastsplat_config_value(const fastsplat_config* config, const char* key, int64_t* out);

// ---- streams (docs/stream.md): a beat is eight 32-bit words, w0 first

enum { FASTSPLAT_BEAT_WORDS = 8 };

enum {
  FASTSPLAT_WHOLE = 0,   ///< a whole recorded stream: tiles, beats and checksum are checked at its end
  FASTSPLAT_SUBSET = 1,  ///< any subset of a stream's tiles
};

// ---- the model: beats in, taps, tiles and counters out

typedef struct fastsplat_model fastsplat_model;

enum {
  FASTSPLAT_TAP_SNAP = 0,       ///< per splat: x0, y0 (two's complement), mx, my
  FASTSPLAT_TAP_FOOTPRINT = 1,  ///< per window: P*P weights, row by row
  FASTSPLAT_TAP_SHEET = 2,      ///< per window: P*P*4 sheet words after it; 0 outside the tile
  FASTSPLAT_TAP_COMPOSITE = 3,  ///< per dirty block: P*P*4 words after compositing; 0 outside the tile
  FASTSPLAT_TAP_PIXEL = 4,      ///< per pixel: R, G, B, A
  FASTSPLAT_TAPS = 5,           ///< how many there are
  FASTSPLAT_ALL_TAPS = 31,      ///< every bit of fastsplat_model_create's `taps`
};

typedef struct fastsplat_tap {
  size_t struct_size;
  uint32_t tap;               ///< FASTSPLAT_TAP_...
  uint32_t tile, sheet, tag;  ///< sheet 0 of a pixel; tag 0 of a block and of a pixel
  int32_t x, y;               ///< first pixel of the window or block, or the pixel, in the tile
  uint32_t words;             ///< of the payload
  const uint32_t* payload;    ///< the library's; until the next call that takes the model
} fastsplat_tap;

typedef struct fastsplat_tile {
  size_t struct_size;
  uint32_t tile;           ///< its number
  int32_t x, y;            ///< its first pixel in the image
  uint32_t width, height;  ///< pixels
  size_t words;            ///< width * height * 4
  const uint32_t* rgba;    ///< row by row; the library's, until the next call that takes the model
} fastsplat_tile;

/// `scope`: FASTSPLAT_WHOLE or FASTSPLAT_SUBSET. `taps`: bit 1 << FASTSPLAT_TAP_... for each tap that is kept to be
/// taken; 0 is fastest.
FASTSPLAT_API fastsplat_status fastsplat_model_create(const fastsplat_config* config, uint32_t scope, uint32_t taps,
                                                      fastsplat_model** out);
FASTSPLAT_API fastsplat_status fastsplat_model_destroy(fastsplat_model* model);

/// `beats` beats of eight words, in stream order, in any pieces. Taps and tiles are kept until they are taken, so take
/// them between pieces. FASTSPLAT_INPUT names the beat and its byte offset; the beats before it were carried out, and
/// only takes, counters, reset and destroy are left.
FASTSPLAT_API fastsplat_status fastsplat_model_feed(fastsplat_model* model, const uint32_t* words, size_t beats);
/// No more beats: FASTSPLAT_INPUT if the stream may not end there. Once; feeding is over.
FASTSPLAT_API fastsplat_status fastsplat_model_finish(fastsplat_model* model);
/// As after create: what was fed and not taken is forgotten.
FASTSPLAT_API fastsplat_status fastsplat_model_reset(fastsplat_model* model);

/// The next tap record, in the model's order over all kinds; FASTSPLAT_NONE when all were taken.
FASTSPLAT_API fastsplat_status fastsplat_model_next_tap(fastsplat_model* model, fastsplat_tap* out);
/// The next finished tile; FASTSPLAT_NONE when all were taken.
FASTSPLAT_API fastsplat_status fastsplat_model_next_tile(fastsplat_model* model, fastsplat_tile* out);

// ---- counters, in the order of the device's registers

/// What the model counts, then the cycle counters that only a device has.
enum { FASTSPLAT_MODEL_COUNTERS = 16, FASTSPLAT_COUNTERS_ALL = 21 };
/// Those of a device with composite.every_sample = 1, which counts one more.
enum { FASTSPLAT_COUNTERS_EVERY_SAMPLE = 22 };
/// Those of a device whose cull.map is not off.
enum { FASTSPLAT_COUNTERS_CULLING = 26 };

/// Name of counter `index`, "splats"; FASTSPLAT_NONE behind the last. The text lives as long as the library.
FASTSPLAT_API fastsplat_status fastsplat_counter_name(size_t index, const char** out);
/// `count` is FASTSPLAT_MODEL_COUNTERS.
FASTSPLAT_API fastsplat_status fastsplat_model_counters(fastsplat_model* model, uint64_t* values, size_t count);

// ---- patterns of docs/verify.md: when a side of a ready/valid channel is willing, by the cycle number

typedef struct fastsplat_pattern fastsplat_pattern;

FASTSPLAT_API fastsplat_status fastsplat_pattern_create(const char* text, uint64_t seed, fastsplat_pattern** out);
FASTSPLAT_API fastsplat_status fastsplat_pattern_destroy(fastsplat_pattern* pattern);
/// *willing: 1 or 0, in cycle `cycle` after reset.
FASTSPLAT_API fastsplat_status fastsplat_pattern_at(const fastsplat_pattern* pattern, uint64_t cycle, int32_t* willing);

// ---- the checker: told what a device took and what its ports show, says whether that is what the model has

typedef struct fastsplat_checker fastsplat_checker;

typedef struct fastsplat_checker_options {
  size_t struct_size;
  uint32_t scope;              ///< FASTSPLAT_WHOLE or FASTSPLAT_SUBSET
  uint64_t stop_after;         ///< mismatches, after which nothing more is compared; 0: 1000
  const char* input_pattern;   ///< when beats are offered, for fastsplat_checker_start; NULL: always
  const char* output_pattern;  ///< when pixels are taken, for fastsplat_checker_start; NULL: always
  uint64_t seed;               ///< of the run: 2 seed is the input pattern's, 2 seed + 1 the output pattern's
  int32_t verdicts;            ///< not 0: FASTSPLAT_PORT_VERDICT is shown, too; one that never comes is a mismatch
} fastsplat_checker_options;

/// `options` may be NULL: a whole stream, 1000 mismatches, both patterns always, no verdicts.
FASTSPLAT_API fastsplat_status fastsplat_checker_create(const fastsplat_config* config,
                                                        const fastsplat_checker_options* options,
                                                        fastsplat_checker** out);
FASTSPLAT_API fastsplat_status fastsplat_checker_destroy(fastsplat_checker* checker);
/// As after create: for a warm reset of the device.
FASTSPLAT_API fastsplat_status fastsplat_checker_reset(fastsplat_checker* checker);

/// Cycles, and verdicts where they are shown, are compared as well: from cycle `first_beat` after reset on beats are
/// offered, and pixels taken, exactly when the patterns are willing (an offered beat stays until it is taken). Before
/// the first beat, once.
FASTSPLAT_API fastsplat_status fastsplat_checker_start(fastsplat_checker* checker, uint64_t first_beat);

/// Beats that the device took. After what its ports showed up to and in that cycle.
FASTSPLAT_API fastsplat_status fastsplat_checker_took(fastsplat_checker* checker, const uint32_t* words, size_t beats);

/// The ports of rtl/fastsplat_core.sv, in the order in which those of one cycle are told.
enum {
  FASTSPLAT_PORT_SNAP = 0,        ///< tag, x, y, mx, my
  FASTSPLAT_PORT_SHEET = 1,       ///< tag; words: tap_sums_o
  FASTSPLAT_PORT_WINDOW = 2,      ///< tag, x, y; words: tap_weights_o
  FASTSPLAT_PORT_COMPOSITE = 3,   ///< block; words: tap_state_o
  FASTSPLAT_PORT_SHEET_DONE = 4,  ///<
  FASTSPLAT_PORT_PIXELS = 5,      ///< last, cut, keep; words: m_tdata_o of a beat that was taken
  FASTSPLAT_PORT_VERDICT = 6,     ///< tag, hidden; passed over where `verdicts` or fastsplat_checker_start is missing
  FASTSPLAT_PORTS = 7,            ///< how many there are
};

/// Bits of fastsplat_shown's `given`: what is compared only where the bench has it.
enum {
  FASTSPLAT_GIVEN_KEEP = 1,  ///<
  FASTSPLAT_GIVEN_TILE = 2,  ///<
};

typedef struct fastsplat_shown {
  size_t struct_size;
  uint32_t port;          ///< FASTSPLAT_PORT_...; the fields it does not have are not read
  uint32_t given;         ///< FASTSPLAT_GIVEN_... of the next two
  uint32_t keep;          ///< m_tkeep_o: which of a beat's pixels lie in the tile, the first in bit 0
  uint32_t tile;          ///< tap_tile_o in that cycle: of a tap's port, and of pixels
  uint64_t cycle;         ///< since reset was released; never falling
  uint32_t tag, x, y;     ///< as the ports have them: x and y two's complement in ORG_BITS
  uint32_t mx, my;        ///<
  uint32_t block;         ///< number in the tile, row by row
  int32_t last;           ///< not 0: ends the tile
  int32_t cut;            ///< m_tuser_o; not 0: marked as of a tile that was cut short, which a whole stream has not
  int32_t hidden;         ///< of a verdict; not 0: nothing of the set is to be seen
  size_t word_count;      ///< fastsplat_checker_port_words() of the port
  const uint32_t* words;  ///< the port's vector, least significant word first; read during the call
} fastsplat_shown;

/// How many 32-bit words the vector of a port has in the checker's configuration; 0 where there is none.
FASTSPLAT_API fastsplat_status fastsplat_checker_port_words(const fastsplat_checker* checker, uint32_t port,
                                                            size_t* out);
FASTSPLAT_API fastsplat_status fastsplat_checker_showed(fastsplat_checker* checker, const fastsplat_shown* shown);

/// *stopped: 1 once so many mismatches were seen that nothing more is compared, else 0.
FASTSPLAT_API fastsplat_status fastsplat_checker_stopped(const fastsplat_checker* checker, int32_t* stopped);

/// The device has come to rest. Its counters, `count` of them: 0 (values NULL: not compared), FASTSPLAT_MODEL_COUNTERS,
/// or, after fastsplat_checker_start always, all that its configuration has. Once. FASTSPLAT_OK is a pass; FASTSPLAT_FAILED one
/// that failed or compared no tap; FASTSPLAT_INPUT a stream that may not end there.
FASTSPLAT_API fastsplat_status fastsplat_checker_finish(fastsplat_checker* checker, const uint64_t* values,
                                                        size_t count);

enum {
  FASTSPLAT_VERDICT_PASS = 0,
  FASTSPLAT_VERDICT_MISMATCH = 1,
  FASTSPLAT_VERDICT_NOTHING_COMPARED = 2,
  FASTSPLAT_VERDICT_OPEN = 3,  ///< not finished, and no mismatch so far
};

typedef struct fastsplat_report {
  size_t struct_size;
  int32_t verdict;                  ///< FASTSPLAT_VERDICT_...
  int32_t detector;                 ///< which saw the first difference: FASTSPLAT_TAP_..., 5 tiles, 6 counters,
                                    ///< 7 cycles, 8 verdicts; -1: none
  uint64_t comparisons;             ///< tap records, pixel words, counters, cycles and verdicts
  uint64_t mismatches;              ///< there may be more once the checker has stopped
  uint64_t by_tap[FASTSPLAT_TAPS];  ///< records compared
  int32_t cycles_compared;          ///< 1: the two that follow are there
  uint64_t cycles_device;           ///< busy cycles
  uint64_t cycles_model;            ///<
} fastsplat_report;

/// At any time.
FASTSPLAT_API fastsplat_status fastsplat_checker_report(const fastsplat_checker* checker, fastsplat_report* out);
/// The first difference in the domain's words (stage, tile, sheet, splat, pixel, both values), else why the stream was
/// refused; "" if there is neither, or for no checker. Valid until the next call that takes the checker; never NULL.
FASTSPLAT_API const char* fastsplat_checker_first_mismatch(const fastsplat_checker* checker);
/// One line on the run: verdict, configuration, comparisons, mismatches, cycles. As above.
FASTSPLAT_API const char* fastsplat_checker_summary(const fastsplat_checker* checker);

#ifdef __cplusplus
}
#endif
