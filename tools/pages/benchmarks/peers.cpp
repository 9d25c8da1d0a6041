// SPDX-License-Identifier: Apache-2.0
// Prints docs/peers.md, made from the peers' JSON files that its arguments name (tools/peers): whether pictures are the
// same, then ratios of CPU time.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "tools/pages/benchmarks/results.hpp"

namespace {

using namespace fastsplat::bench;

/// Ratio of the CPU times of two lines, `above` / `below`.
struct Row {
  const char* what;
  const char* above;
  const char* below;
  Goal kind;
  double goal;
};
constexpr Row kRows[] = {
    {"head 512², shaded: `base` / VTK's first frame", "base/head512", "vtk-first/head512", Goal::AtMost, 1.0},
    {"head 512², shaded: `compact` / VTK's first frame", "compact/head512", "vtk-first/head512", Goal::AtMost, 0.9},
    {"head 512², shaded: `base` / VTK's later ones", "base-later/head512", "vtk/head512", Goal::AtMost, 1.5},
    {"head 512², shaded: `compact` / VTK's later ones", "compact-later/head512", "vtk/head512", Goal::AtMost, 1.2},
    {"head 512², an orbit of 36 frames: `base` / VTK", "orbit-base/head512", "orbit-vtk/head512", Goal::AtMost, 1.5},
    {"head 512², an orbit of 36 frames: `compact` / VTK", "orbit-compact/head512", "orbit-vtk/head512", Goal::AtMost,
     1.2},
    {"shells 256³, 512², shaded: `base` / VTK's first frame", "base/shells256", "vtk-first/shells256", Goal::AtMost,
     0.9},
    {"shells 256³, 512², shaded: `base` / VTK's later ones", "base-later/shells256", "vtk/shells256", Goal::AtMost,
     1.5},
    {"head 512², `base`: with counters / without", "base-counted/head512", "base/head512", Goal::AtLeast, 3},
    {"X-ray of the head, 512²: GL (16 bits), drawing / `base`, whole frame", "gl16/draw", "fast/frame/base",
     Goal::AtLeast, 25},
    {"X-ray: GL (16 bits), drawing / `compact`, whole frame", "gl16/draw", "fast/frame/compact", Goal::AtLeast, 25},
    {"X-ray: GL (16 bits), drawing / `base`, drawing", "gl16/draw", "fast/draw/base", Goal::AtLeast, 25},
    {"X-ray: GL (16 bits), drawing / `compact`, drawing", "gl16/draw", "fast/draw/compact", Goal::AtLeast, 25},
    {"X-ray: GL (32 bits), drawing / `base`, drawing", "gl32/draw", "fast/draw/base", Goal::AtLeast, 25},
    {"X-ray: GL (16 bits), drawing / `base`, plain unit, whole frame", "gl16/draw", "plain/frame/base", Goal::AtLeast,
     3},
    {"rows of 7 px, `base`: SystemC / plain unit", "systemc/rows7/base", "plain/rows7/base", Goal::AtLeast, 100},
    {"rows of 7 px, `compact`: SystemC / plain unit", "systemc/rows7/compact", "plain/rows7/compact", Goal::AtLeast,
     100},
    {"rows of 7 px, `base`: SystemC / fast unit", "systemc/rows7/base", "fast/rows7/base", Goal::AtLeast, 2000},
    {"rows of 7 px, `compact`: SystemC / fast unit", "systemc/rows7/compact", "fast/rows7/compact", Goal::AtLeast,
     2000},
};

/// A line that compares two pictures, and its title.
struct Picture {
  const char* line;
  const char* what;
};
constexpr Picture kPictures[] = {
    {"picture/head512/vtk-unshaded/golden-post",
     "head, unshaded: VTK beside golden in VTK's order (`--classify post`)"},
    {"picture/head512/golden-pre/golden-post", "head, unshaded: golden, classified before and after splatting"},
    {"picture/head512/vtk/base", "head, as timed: VTK shades samples, `base` voxels"},
    {"picture/head512/orbit/vtk/base", "head, the orbit's worst frame: VTK beside `base`"},
    {"picture/head512/compact/base", "head, as timed: `compact` beside `base`"},
    {"picture/shells256/vtk-unshaded/golden-post", "shells, unshaded: VTK beside golden in VTK's order"},
    {"picture/shells256/golden-pre/golden-post", "shells, unshaded: golden, classified before and after splatting"},
    {"picture/shells256/vtk/base", "shells, as timed: VTK beside `base`"},
    {"picture/shells256/compact/base", "shells, as timed: `compact` beside `base`"},
    {"picture/gl16/golden", "X-ray: GL, sums of 16 bits, beside golden"},
    {"picture/gl16/base", "X-ray: GL, sums of 16 bits, beside `base`"},
    {"picture/gl32/golden", "X-ray: GL, sums of 32 bits, beside golden"},
    {"picture/gl32/base", "X-ray: GL, sums of 32 bits, beside `base`"},
    {"picture/gl32/compact", "X-ray: GL, sums of 32 bits, beside `compact`"},
};

void print_pictures(const Results& results) {
  std::cout << "| two pictures | PSNR, dB | silhouettes overlap |\n|---|---|---|\n";
  for (const Picture& picture : kPictures) {
    const Line* line = results.line(picture.line);
    if (line == nullptr) continue;
    const auto overlap = line->counters.find("overlap");
    std::cout << fmt::format("| {} | {:.1f} | {} |\n", picture.what, line->counters.at("psnr_db"),
                             overlap == line->counters.end() ? "" : fmt::format("{:.1f} %", 100 * overlap->second));
  }
  for (const char* config : {"base", "compact"}) {
    const Line* line = results.line(std::string("words/") + config);
    if (line == nullptr) continue;
    std::cout << fmt::format(
        "{}SystemC beside the plain unit, `{}`: {:.0f} of {:.0f} words different ({:.0f} sums saturated).\n",
        config == std::string("base") ? "\n" : "", config, line->counters.at("different"), line->counters.at("words"),
        line->counters.at("saturated"));
  }
}

std::string voxels(double length) { return length == 1.0 ? "voxel" : fmt::format("1/{:.0f} voxel", 1.0 / length); }

/// Prints nothing without a head.
void print_post_classified(const Results& results) {
  bool any = false;
  for (const auto& [name, line] : results.lines) {
    if (!name.starts_with("post/")) continue;
    if (!std::exchange(any, true))
      std::cout
          << "\n## Classified by pixel, as VTK does it\n\n| VTK draws | its samples, every | our sheets, every | "
             "golden, dB | `base`, dB | `fine`, dB | golden's silhouette in common |\n|---|---|---|---|---|---|---|\n";
    const auto& figure = line.counters;
    const double points = figure.at("points");
    std::cout << fmt::format(
        "| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} % |\n",
        points == 1.0 ? "the volume" : fmt::format("the filtered volume, {:.0f} points a voxel", points),
        voxels(figure.at("samples")), voxels(figure.at("sheets")), figure.at("golden"), figure.at("base"),
        figure.at("fine"), 100 * figure.at("overlap"));
  }
}

void print_rows(const Results& results) {
  print_heading("ratio of medians, CPU time");
  for (const Row& row : kRows) {
    const Line* above = results.line(row.above);
    const Line* below = results.line(row.below);
    if (above != nullptr && below != nullptr) print_goal(row.what, ratio(above->cpu, below->cpu), row.kind, row.goal);
  }
}

void print_lines(const Results& results) {
  std::cout << "\n| line | CPU ms, median | least | greatest |\n|---|---|---|---|\n";
  for (const auto& [name, line] : results.lines) {
    if (name.starts_with("picture/") || name.starts_with("words/") || name.starts_with("post/")) continue;
    std::cout << fmt::format("| {} | {:.3g} | {:.3g} | {:.3g} |\n", name, median(line.cpu),
                             *std::ranges::min_element(line.cpu), *std::ranges::max_element(line.cpu));
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count < 2) throw std::runtime_error("expected the JSON of the peers");
  const std::vector<std::string> files(arguments + 1, arguments + count);
  const Results results = read_results(files);
  const Line* gl = results.line("picture/gl16/golden");
  std::cout << "<!-- Made by tools/peers; the words are in tools/pages/benchmarks/peers_preface.md. -->\n"
            << std::ifstream(FASTSPLAT_SOURCE_DIR "/tools/pages/benchmarks/peers_preface.md").rdbuf()
            << "\n## Measured\n\n"
            << fmt::format("{}; {}{}{}; {} repetitions, interleaved at random.\n\n", results.machine,
                           FASTSPLAT_COMPILER, gl == nullptr ? "" : "; OpenGL: ", gl == nullptr ? "" : gl->label,
                           results.repetitions());
  print_rows(results);
  std::cout << "\n## The same pictures, the same words\n\n";
  print_pictures(results);
  print_post_classified(results);
  std::cout << "\n## Lines\n";
  print_lines(results);
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "peers table: " << problem.what() << "\n";
  return 1;
}
