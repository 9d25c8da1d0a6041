// SPDX-License-Identifier: Apache-2.0
#include "cli/render_arguments.hpp"

#include "cli/image_output.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::cli {

void declare(Options& options, RenderArguments& to) {
  declare(options, to.scene);
  declare(options, to.gaussians);
  options.group("Engine");
  options.word("--engine", to.engine, "golden|cmodel|rtl",
               "golden (floating point), cmodel (the integer device model) or rtl (its Verilated RTL)");
  options.values([] { return std::vector<std::string>{"golden", "cmodel", "rtl"}; });
  declare(options, to.config, "cmodel, rtl: hardware configuration, a name or TOML file (base)");
  options.flag("--check", to.check, "rtl: compare every tap, pixel and counter with the model (exit 1 on a mismatch)");
  declare(options, to.wave);
  options.flag("--counters", to.counters,
               "cmodel: visit and count also what no pixel depends on, as the device does; same picture, slower (--json "
               "and --plain do so, too)");
  options.flag("--no-counters", to.no_counters,
               "cmodel: leave the counters out even with --json, unless --counters or --plain is given");
  options.flag("--plain", to.plain,
               "golden, cmodel: use the plain implementation (cmodel: the unit that the RTL is checked against); same "
               "picture, slower");
  options.group("Animation");
  options.word("--orbit", to.orbit, "A..B",
               "animate the azimuth from A to B degrees, both included; 0..360 is a full turn");
  options.flag("--sequence", to.sequence,
               "animate as described by the scene's [sequence]; of 3-D Gaussians, all cameras of --cameras");
  options.integer("--frames", to.frames, 1, scene::kMaxFrames, "N",
                  "number of frames; # in --out become their numbers, from 0");
  options.integer("--keep-memory", to.keep_memory, 0, 1 << 20, "MIB",
                  "cmodel: keep up to this much of the classified voxels from frame to frame (a quarter of the "
                  "memory); same pictures, 0 is slower");
  options.word("--video", to.video, "FILE", "write the PNG frames as a video, .mp4, .mkv or .webm (requires ffmpeg)");
  options.number("--rate", to.rate, "NUMBER", "frames per second of the video (24)");
  declare_images(options, to.out, to.raw);
  options.word("--save-scene", to.save_scene, "FILE", "write the scene with all flags applied as TOML");
  declare(options, to.common);
  options.example("fastsplat render --volume shells:64 --size 256 -o golden.exr -o golden.png",
                  "the reference picture, to measure against and to view");
  options.example(
      "fastsplat render --volume shells:64 --size 256 --engine cmodel --config base -o model.exr -o model.png",
      "the integer device's picture of the same scene");
  options.example("fastsplat render --volume shells:32 --size 96 --orbit 0..360 --frames 6 -o turn-#.png",
                  "a full turn, one picture per step");
}

}  // namespace fastsplat::cli
