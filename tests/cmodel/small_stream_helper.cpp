// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/small_stream_helper.hpp"

#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {

cmodel::Config small_stream_config() {
  oracle::Symbols c;
  c.P = 2, c.W = 8, c.H = 8;
  c.pi = 6, c.pf = 2, c.k = 2;
  c.sets = 3, c.columns = 8, c.g = 1;
  c.N = 4, c.wi = 1, c.wf = 2;
  c.cf = 8, c.zf = 0, c.hf = 2;
  c.si = 1, c.sf = 6;
  c.G = 2, c.of = 4;
  c.tf = 6, c.eps = 2;
  c.xi = 1, c.xf = 6;
  return config_of(c, "small_stream");
}

std::vector<std::uint8_t> small_stream() {
  StreamWriter w(symbols_of(small_stream_config()));
  w.begin_frame(16, 8, 2);
  w.load_table(0, 1, 2, 2, {0, 3, 5, 8});
  w.load_table(1, 0, 0, 0, {7, 5, 2, 1});
  w.load_table(2, 0, 0, 0, {16, 11, 8});
  w.begin_tile(0, 0, 0, 0, 8, 8);
  w.begin_sheet(3);
  w.splat(1, 5, 9, {200, 100, 50, 255});
  w.cull_block(7, -3, 2, 4, 5, 1);
  w.splat(1, -2, 31, {1, 2, 3, 40});
  w.end_sheet();
  w.begin_sheet(5);
  w.end_sheet();
  w.end_tile();
  w.begin_tile(2, 1, 8, 0, 8, 8);
  w.begin_sheet(0);
  w.splat(1, 12, 12, {9, 8, 7, 6});
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

std::vector<std::uint8_t> stream_with_tables(const cmodel::Config& config, int mode, const LoadedTables& tables) {
  StreamWriter w(symbols_of(config));
  w.begin_frame(16, 16, 1);
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_words())));
  w.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1));
  for (const auto& [table, words] : tables) w.load_table(table, 0, 0, 0, words);
  w.begin_tile(mode, 0, 0, 0, 8, 8);
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

}  // namespace fastsplat::test
