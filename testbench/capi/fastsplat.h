// SPDX-License-Identifier: Apache-2.0
// The C interface of libfastsplat: the integer device model and the passive checker, for benches in any language.
// docs/capi.md is its page: the contract, an example, every status. Version 3.0; C99 and C++.
//
// Every function that can fail returns a fastsplat_status and leaves one line of text for fastsplat_last_error(). A
// failing call changes nothing but that text. No C++ exception leaves the library.
// Handles are opaque. The caller destroys the handles that it created; destroying NULL does nothing. Any pointer other
// than a live handle of the right kind is refused. A handle keeps nothing of the handles and the memory it was made
// from.
// Different threads may use different handles at the same time. One thread at a time may use a handle; a configuration,
// which never changes, may be used by any number.
// Structures begin with struct_size, which the caller sets to sizeof of the structure it was compiled with. A later
// library reads and fills no more than that.
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

/// Version of the loaded library: major << 16 | minor. Programs need the same major and at least their own minor
/// version.
FASTSPLAT_API uint32_t fastsplat_api_version(void);
/// The program's version, "0.2.0"; never NULL.
FASTSPLAT_API const char* fastsplat_version(void);

/// Values are the exit codes of the command line where both exist.
typedef int32_t fastsplat_status;
enum {
  FASTSPLAT_NONE = -1,       ///< nothing to take now; no error
  FASTSPLAT_OK = 0,          ///< success
  FASTSPLAT_FAILED = 1,      ///< fastsplat_checker_finish: mismatches, or no tap compared
  FASTSPLAT_USAGE = 2,       ///< an invalid argument, or a call out of order
  FASTSPLAT_INPUT = 3,       ///< a configuration or a stream breaks its rules
  FASTSPLAT_INTERNAL = 70,   ///< an internal error of the library
  FASTSPLAT_NO_MEMORY = 71,  ///< out of memory
};

/// Error text of the last failing call on this thread, one line; "" before any. Valid until the next failing call on
/// this thread; never NULL.
FASTSPLAT_API const char* fastsplat_last_error(void);

// ---- configurations

typedef struct fastsplat_config fastsplat_config;

/// Creates a built-in configuration, e.g. "tiny".
FASTSPLAT_API fastsplat_status fastsplat_config_named(const char* name, fastsplat_config** out);
/// Creates a configuration from `bytes` bytes of TOML text; messages name it `where` (NULL: "configuration").
FASTSPLAT_API fastsplat_status fastsplat_config_text(const char* toml, size_t bytes, const char* where,
                                                     fastsplat_config** out);
/// Creates a configuration from a TOML file.
FASTSPLAT_API fastsplat_status fastsplat_config_file(const char* path, fastsplat_config** out);
FASTSPLAT_API fastsplat_status fastsplat_config_destroy(fastsplat_config* config);

/// Name `index` of the built-in configurations; FASTSPLAT_NONE past the last. The text lives as long as the library.
FASTSPLAT_API fastsplat_status fastsplat_config_name(size_t index, const char** out);
/// The configuration hash, 64 bits, as in begin_frame and in the device's registers.
FASTSPLAT_API fastsplat_status fastsplat_config_hash(const fastsplat_config* config, uint64_t* out);
/// Value of a key of the file, e.g. "array.lanes"; for a key with named values, the value's place in their list.
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
  FASTSPLAT_TAPS = 5,           ///< number of taps
  FASTSPLAT_ALL_TAPS = 31,      ///< all bits of fastsplat_model_create's `taps`
};

typedef struct fastsplat_tap {
  size_t struct_size;
  uint32_t tap;               ///< FASTSPLAT_TAP_...
  uint32_t tile, sheet, tag;  ///< sheet is 0 for pixels; tag is 0 for blocks and pixels
  int32_t x, y;               ///< first pixel of the window or block, or the pixel, in the tile
  uint32_t words;             ///< number of words in the payload
  const uint32_t* payload;    ///< owned by the library; valid until the next call with the model
} fastsplat_tap;

typedef struct fastsplat_tile {
  size_t struct_size;
  uint32_t tile;           ///< its number
  int32_t x, y;            ///< its first pixel in the image
  uint32_t width, height;  ///< pixels
  size_t words;            ///< width * height * 4
  const uint32_t* rgba;    ///< row by row; owned by the library, valid until the next call with the model
} fastsplat_tile;

/// `scope`: FASTSPLAT_WHOLE or FASTSPLAT_SUBSET. `taps`: bit 1 << FASTSPLAT_TAP_... for each tap to keep for
/// fastsplat_model_next_tap; 0 is fastest.
FASTSPLAT_API fastsplat_status fastsplat_model_create(const fastsplat_config* config, uint32_t scope, uint32_t taps,
                                                      fastsplat_model** out);
FASTSPLAT_API fastsplat_status fastsplat_model_destroy(fastsplat_model* model);

/// Feeds `beats` beats of eight words, in stream order, in pieces of any size. Taps and tiles are kept until they are
/// taken: take them between pieces. On FASTSPLAT_INPUT the error text has the beat and its byte offset. The beats
/// before it were carried out. Then only next_tap, next_tile, counters, reset and destroy are allowed.
FASTSPLAT_API fastsplat_status fastsplat_model_feed(fastsplat_model* model, const uint32_t* words, size_t beats);
/// Ends the stream; call once, no beats may follow. FASTSPLAT_INPUT if the stream may not end here.
FASTSPLAT_API fastsplat_status fastsplat_model_finish(fastsplat_model* model);
/// Restores the state after create; taps and tiles that were not taken are lost.
FASTSPLAT_API fastsplat_status fastsplat_model_reset(fastsplat_model* model);

/// Takes the next tap record, in the model's order over all kinds; FASTSPLAT_NONE if none is left.
FASTSPLAT_API fastsplat_status fastsplat_model_next_tap(fastsplat_model* model, fastsplat_tap* out);
/// Takes the next finished tile; FASTSPLAT_NONE if none is left.
FASTSPLAT_API fastsplat_status fastsplat_model_next_tile(fastsplat_model* model, fastsplat_tile* out);

// ---- counters, in the order of the device's registers

/// Number of counters of the model; of a device, with the cycle counters that only it has.
enum { FASTSPLAT_MODEL_COUNTERS = 16, FASTSPLAT_COUNTERS_ALL = 21 };
/// Number of counters of a device with composite.every_sample = 1.
enum { FASTSPLAT_COUNTERS_EVERY_SAMPLE = 22 };
/// Number of counters of a device whose cull.map is not off.
enum { FASTSPLAT_COUNTERS_CULLING = 26 };

/// Name of counter `index`, e.g. "splats"; FASTSPLAT_NONE past the last. The text lives as long as the library.
FASTSPLAT_API fastsplat_status fastsplat_counter_name(size_t index, const char** out);
/// `count` must be FASTSPLAT_MODEL_COUNTERS.
FASTSPLAT_API fastsplat_status fastsplat_model_counters(fastsplat_model* model, uint64_t* values, size_t count);

// ---- ready/valid patterns (docs/verify.md): in which cycles a side of a channel is ready

typedef struct fastsplat_pattern fastsplat_pattern;

FASTSPLAT_API fastsplat_status fastsplat_pattern_create(const char* text, uint64_t seed, fastsplat_pattern** out);
FASTSPLAT_API fastsplat_status fastsplat_pattern_destroy(fastsplat_pattern* pattern);
/// *ready: 1 if the side is ready in cycle `cycle` after reset, else 0.
FASTSPLAT_API fastsplat_status fastsplat_pattern_at(const fastsplat_pattern* pattern, uint64_t cycle, int32_t* ready);

// ---- the checker: compares the beats that a device took and its port values with the model

typedef struct fastsplat_checker fastsplat_checker;

typedef struct fastsplat_checker_options {
  size_t struct_size;
  uint32_t scope;              ///< FASTSPLAT_WHOLE or FASTSPLAT_SUBSET
  uint64_t stop_after;         ///< number of mismatches after which nothing more is compared; 0: 1000
  const char* input_pattern;   ///< when beats are offered, for fastsplat_checker_start; NULL: always
  const char* output_pattern;  ///< when pixels are taken, for fastsplat_checker_start; NULL: always
  uint64_t seed;               ///< seed of the run; the input pattern's is 2 seed, the output pattern's 2 seed + 1
  int32_t verdicts;            ///< not 0: FASTSPLAT_PORT_VERDICT is shown, too; a missing verdict is a mismatch
} fastsplat_checker_options;

/// `options` may be NULL: a whole stream, 1000 mismatches, both patterns always, no verdicts.
FASTSPLAT_API fastsplat_status fastsplat_checker_create(const fastsplat_config* config,
                                                        const fastsplat_checker_options* options,
                                                        fastsplat_checker** out);
FASTSPLAT_API fastsplat_status fastsplat_checker_destroy(fastsplat_checker* checker);
/// Restores the state after create, for a warm reset of the device.
FASTSPLAT_API fastsplat_status fastsplat_checker_reset(fastsplat_checker* checker);

/// Also compares cycles, and verdicts if they are shown. From cycle `first_beat` after reset on, the bench has to offer
/// beats and take pixels exactly as the patterns say; an offered beat stays until it is taken. Call once, before the
/// first beat.
FASTSPLAT_API fastsplat_status fastsplat_checker_start(fastsplat_checker* checker, uint64_t first_beat);

/// Reports beats that the device took; first show what its ports showed up to and including that cycle.
FASTSPLAT_API fastsplat_status fastsplat_checker_took(fastsplat_checker* checker, const uint32_t* words, size_t beats);

/// The ports of rtl/fastsplat_core.sv; show the events of one cycle in this order.
enum {
  FASTSPLAT_PORT_SNAP = 0,        ///< tag, x, y, mx, my
  FASTSPLAT_PORT_SHEET = 1,       ///< tag; words: tap_sums_o
  FASTSPLAT_PORT_WINDOW = 2,      ///< tag, x, y; words: tap_weights_o
  FASTSPLAT_PORT_COMPOSITE = 3,   ///< block; words: tap_state_o
  FASTSPLAT_PORT_SHEET_DONE = 4,  ///<
  FASTSPLAT_PORT_PIXELS = 5,      ///< last, cut, keep; words: m_tdata_o of a beat that was taken
  FASTSPLAT_PORT_VERDICT = 6,     ///< tag, hidden; ignored without `verdicts` or fastsplat_checker_start
  FASTSPLAT_PORTS = 7,            ///< number of ports
};

/// Bits of fastsplat_shown's `given`: values that are compared only if the bench provides them.
enum {
  FASTSPLAT_GIVEN_KEEP = 1,  ///<
  FASTSPLAT_GIVEN_TILE = 2,  ///<
};

typedef struct fastsplat_shown {
  size_t struct_size;
  uint32_t port;          ///< FASTSPLAT_PORT_...; fields that the port lacks are not read
  uint32_t given;         ///< FASTSPLAT_GIVEN_...: which of the next two are valid
  uint32_t keep;          ///< m_tkeep_o: which of a beat's pixels lie in the tile, the first in bit 0
  uint32_t tile;          ///< tap_tile_o in that cycle; for taps and pixels
  uint64_t cycle;         ///< since reset was released; must not decrease
  uint32_t tag, x, y;     ///< as the ports have them: x and y two's complement in ORG_BITS
  uint32_t mx, my;        ///<
  uint32_t block;         ///< number in the tile, row by row
  int32_t last;           ///< not 0: ends the tile
  int32_t cut;            ///< m_tuser_o; not 0: the tile is marked as cut short, a mismatch
  int32_t hidden;         ///< of a verdict; not 0: the cull group is hidden
  size_t word_count;      ///< fastsplat_checker_port_words() of the port
  const uint32_t* words;  ///< the port's vector, least significant word first; read during the call
} fastsplat_shown;

/// *out: number of 32-bit words of the port's vector in the checker's configuration; 0 if the port has none.
FASTSPLAT_API fastsplat_status fastsplat_checker_port_words(const fastsplat_checker* checker, uint32_t port,
                                                            size_t* out);
FASTSPLAT_API fastsplat_status fastsplat_checker_showed(fastsplat_checker* checker, const fastsplat_shown* shown);

/// *stopped: 1 once nothing more is compared (too many mismatches, or a silent device), else 0.
FASTSPLAT_API fastsplat_status fastsplat_checker_stopped(const fastsplat_checker* checker, int32_t* stopped);

/// Ends the run; call once, after the device has come to rest. `values` are its `count` counters: 0 (values NULL: not
/// compared), FASTSPLAT_MODEL_COUNTERS, or all of its configuration; after fastsplat_checker_start always all.
/// FASTSPLAT_OK is a pass. FASTSPLAT_FAILED: mismatches, or no tap compared. FASTSPLAT_INPUT: the stream may not end
/// here.
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
  int32_t detector;                 ///< what found the first difference: FASTSPLAT_TAP_..., 5 tiles, 6 counters, 7
                                    ///< cycles, 8 verdicts; -1: none
  uint64_t comparisons;             ///< tap records, pixel words, counters, cycles and verdicts
  uint64_t mismatches;              ///< there may be more if the checker has stopped
  uint64_t by_tap[FASTSPLAT_TAPS];  ///< records compared
  int32_t cycles_compared;          ///< 1: the next two are valid
  uint64_t cycles_device;           ///< busy cycles
  uint64_t cycles_model;            ///<
} fastsplat_report;

/// May be called at any time.
FASTSPLAT_API fastsplat_status fastsplat_checker_report(const fastsplat_checker* checker, fastsplat_report* out);
/// The first difference: stage, tile, sheet, splat, pixel, both values; else why the stream was refused; "" if there is
/// neither, or without a checker. Valid until the next call with the checker; never NULL.
FASTSPLAT_API const char* fastsplat_checker_first_mismatch(const fastsplat_checker* checker);
/// Summary in one line: verdict, configuration, comparisons, mismatches, cycles. Valid as above.
FASTSPLAT_API const char* fastsplat_checker_summary(const fastsplat_checker* checker);

#ifdef __cplusplus
}
#endif
