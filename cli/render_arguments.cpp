#include "cli/render_arguments.hpp"

#include "cli/image_output.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::cli {

void declare(Options& options, RenderArguments& to) {
  declare(options, to.scene);
  declare(options, to.gaussians);
  options.group("Engine");
  options.word("--engine", to.engine, "golden|cmodel|rtl",
               "golden (floating point), cmodel (the integer device) or rtl (its Verilated RTL)");
  options.values([] { return std::vector<std::string>{"golden", "cmodel", "rtl"}; });
  declare(options, to.config, "cmodel, rtl: hardware configuration, a name or a TOML file (default base)");
  options.flag("--check", to.check, "rtl: compares every tap, pixel and counter with the model (exit 1)");
  declare(options, to.wave);
  options.flag(
      "--plain", to.plain,
      "golden, cmodel: drawn as it is written down (cmodel: by the unit that the RTL is held to), not the fast way; "
      "the same picture");
  options.group("Animation");
  options.word("--orbit", to.orbit, "A..B", "azimuth from A to B degrees, both included; 0..360 is a whole turn");
  options.flag("--sequence", to.sequence, "what the scene's [sequence] says");
  options.integer("--frames", to.frames, 1, scene::kMaxFrames, "N",
                  "frames; the # in --out become their numbers, from 0");
  options.word("--video", to.video, "FILE", "the PNG frames as a video, .mp4, .mkv or .webm (needs ffmpeg)");
  options.number("--rate", to.rate, "NUMBER", "the video's frames a second (24)");
  declare_images(options, to.out, to.raw);
  options.word("--save-scene", to.save_scene, "FILE", "writes the scene, flags applied, as TOML");
  declare(options, to.common);
  options.example("fastsplat render --volume shells:64 --size 256 -o golden.exr -o golden.png",
                  "the true picture, to measure by and to look at");
  options.example(
      "fastsplat render --volume shells:64 --size 256 --engine cmodel --config base -o model.exr -o model.png",
      "the integer device's picture of the same");
  options.example("fastsplat render --volume shells:32 --size 96 --orbit 0..360 --frames 6 -o turn-#.png",
                  "a turn around it, a picture a step");
}

}  // namespace fastsplat::cli
