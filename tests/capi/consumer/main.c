// SPDX-License-Identifier: Apache-2.0
// consumer CONFIG FILE.fss: feeds a recorded stream to the model. Prints "NAME VALUE" of every counter, then "pixels
// SUM" of all words. Errors go to stderr, and their status is the exit code.
#include <fastsplat.h>
#include <fastsplat_dpi.h>
#include <fastsplat_registers.h>
#include <inttypes.h>
#include <stdio.h>

_Static_assert(FASTSPLAT_REG_COUNTER_HIGH(FASTSPLAT_COUNTER_SHEETS) == 0x8Cu, "an address is one");
_Static_assert(FASTSPLAT_ERROR_OPCODE_MASK == 0xFFu << FASTSPLAT_ERROR_OPCODE_BIT, "a mask is its field's");

static int refused(fastsplat_status status) {
  fprintf(stderr, "%s\n", fastsplat_last_error());
  return status;
}

int main(int argc, char** argv) {
  if (argc != 3) return FASTSPLAT_USAGE;
  fastsplat_config* config = NULL;
  fastsplat_status status = fastsplat_config_named(argv[1], &config);
  if (status != FASTSPLAT_OK) return refused(status);
  fastsplat_model* model = NULL;
  status = fastsplat_model_create(config, FASTSPLAT_WHOLE, 0, &model);
  fastsplat_config_destroy(config);
  if (status != FASTSPLAT_OK) return refused(status);

  FILE* file = fopen(argv[2], "rb");
  if (file == NULL) return FASTSPLAT_INPUT;
  uint32_t beat[FASTSPLAT_BEAT_WORDS];
  while (status == FASTSPLAT_OK && fread(beat, sizeof beat, 1, file) == 1)
    status = fastsplat_model_feed(model, beat, 1);
  fclose(file);
  if (status == FASTSPLAT_OK) status = fastsplat_model_finish(model);
  if (status != FASTSPLAT_OK) return refused(status);

  uint64_t counters[FASTSPLAT_MODEL_COUNTERS], sum = 0;
  fastsplat_model_counters(model, counters, FASTSPLAT_MODEL_COUNTERS);
  for (size_t i = 0; i < FASTSPLAT_MODEL_COUNTERS; ++i) {
    const char* name = NULL;
    fastsplat_counter_name(i, &name);
    printf("%s %" PRIu64 "\n", name, counters[i]);
  }
  fastsplat_tile tile = {.struct_size = sizeof tile};
  while (fastsplat_model_next_tile(model, &tile) == FASTSPLAT_OK)
    for (size_t i = 0; i < tile.words; ++i) sum += tile.rgba[i];
  printf("pixels %" PRIu64 "\n", sum);
  return fastsplat_model_destroy(model);
}
