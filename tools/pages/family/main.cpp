// SPDX-License-Identifier: Apache-2.0
// fastsplat_family_page FOLDER: prints docs/family.md and writes its pictures to FOLDER (tools/family).
#include <filesystem>
#include <iostream>

#include "analysis/index_kinds/head.hpp"
#include "base/atomic_file.hpp"
#include "tools/pages/family/family_page.hpp"
#include "tools/pages/family/family_plots.hpp"

int main(int count, char** words) {
  using namespace fastsplat;
  if (count != 2 || !std::filesystem::is_directory(words[1])) {
    std::cerr << "fastsplat_family_page: error: expected the folder of the pictures\n";
    return 2;
  }
  const auto cells = analysis::page_cells();
  for (const auto& picture : analysis::family_plots(cells))
    write_text_file(std::filesystem::path(words[1]) / picture.file, picture.svg);
  const auto head = analysis::head_scene();
  std::cout << analysis::family_page(
      cells, analysis::head_section(head, analysis::head_table(head, analysis::whole_head(), 0, {})));
}
