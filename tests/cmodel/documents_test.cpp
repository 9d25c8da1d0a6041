// SPDX-License-Identifier: Apache-2.0
// docs/stream.md and docs/numerics.md against the code: the tables of pages and headers agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cmodel/io/register_fields.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "cmodel/stream/stream_layout.hpp"
#include "cmodel/stream/stream_rules.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

std::vector<std::string> lines_of(const std::string& page) {
  std::ifstream file(std::string(FASTSPLAT_SOURCE_DIR) + "/docs/" + page);
  EXPECT_TRUE(file) << page;
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Cells of a "| a | b |" line.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream stream(line.substr(std::min<std::size_t>(1, line.size())));
  for (std::string cell; std::getline(stream, cell, '|');) out.push_back(trimmed(cell));
  return out;
}

struct PageField {
  int word, lsb, bits;
  std::string text;  ///< from its position to the next one
};

std::vector<PageField> fields_of(const std::string& text) {
  static const std::regex position(R"(\bw([0-7])(\[(\d+):(\d+)\])?)");
  std::vector<PageField> fields;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), position); it != std::sregex_iterator(); ++it) {
    const std::smatch& m = *it;
    const int high = m[3].matched ? std::stoi(m[3]) : 31, low = m[4].matched ? std::stoi(m[4]) : 0;
    const auto next = std::next(it);
    const auto end = next == std::sregex_iterator() ? text.size() : static_cast<std::size_t>(next->position());
    const auto begin = static_cast<std::size_t>(m.position() + m.length());
    fields.push_back({std::stoi(m[1]), low, high - low + 1, text.substr(begin, end - begin)});
  }
  return fields;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// S-record-4.
TEST(StreamPage, EveryFieldLiesWhereTheLayoutSays) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines_of("stream.md"))
    if (line.rfind("| 0x", 0) == 0) rows.push_back(cells(line));

  const auto layouts = cmodel::record_layouts();
  ASSERT_EQ(rows.size(), layouts.size()) << "records in the page and in the layout";
  int fields_compared = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const cmodel::RecordLayout& layout = layouts[i];
    EXPECT_EQ(std::stoi(rows[i][0], nullptr, 16), static_cast<int>(layout.opcode)) << layout.name;
    EXPECT_EQ(rows[i][1], layout.name);
    const std::vector<PageField> fields = fields_of(rows[i][2]);
    ASSERT_EQ(fields.size(), layout.fields.size()) << layout.name << ": fields in the page and in the layout";
    for (std::size_t j = 0; j < fields.size(); ++j) {
      const cmodel::NamedField& named = layout.fields[j];
      EXPECT_EQ(fields[j].word, named.field.word) << layout.name << '.' << named.name;
      EXPECT_EQ(fields[j].lsb, named.field.lsb) << layout.name << '.' << named.name;
      EXPECT_EQ(fields[j].bits, named.field.bits) << layout.name << '.' << named.name;
      // "w1, w2 number of beats, low and high": the text of such a pair follows its second half.
      std::string stem(named.name);
      std::size_t said_at = j;
      if (const auto half = stem.find('_'); half != std::string::npos) {
        said_at = stem.substr(half) == "_low" ? j + 1 : j;
        stem.resize(half);
      }
      const std::regex word("(^|[^a-z])" + stem + "([^a-z]|$)");
      EXPECT_TRUE(std::regex_search(lower(fields[said_at].text), word))
          << layout.name << '.' << named.name << " is not named at its place: " << fields[said_at].text;
      ++fields_compared;
    }
  }
  std::printf("[figure] fields of the stream page held against the layout = %d\n", fields_compared);
  EXPECT_EQ(fields_compared, 55);
}

TEST(StreamPage, FieldsOfARecordDoNotOverlap) {
  for (const cmodel::RecordLayout& layout : cmodel::record_layouts()) {
    cmodel::Beat used{};
    used[0] = cmodel::field_mask(cmodel::layout::kOpcode);
    for (const auto& named : layout.fields) {
      auto& word = used[static_cast<std::size_t>(named.field.word)];
      EXPECT_EQ(word & cmodel::field_mask(named.field), 0U) << layout.name << '.' << named.name;
      word |= cmodel::field_mask(named.field);
    }
  }
}

TEST(StreamPage, MagicVersionAndEnumerations) {
  std::string page;
  for (const std::string& line : lines_of("stream.md")) page += line + '\n';
  char magic[16];
  std::snprintf(magic, sizeof magic, "0x%08x", cmodel::kStreamMagic);
  EXPECT_NE(lower(page).find(magic), std::string::npos);
  EXPECT_NE(page.find("version (" + std::to_string(cmodel::kStreamVersion) + ")"), std::string::npos);
  const auto has = [&](auto value, const char* name) {
    EXPECT_NE(page.find(std::to_string(static_cast<int>(value)) + " " + name), std::string::npos) << name;
  };
  has(cmodel::Table::Rlut, "RLUT");
  has(cmodel::Table::Radial, "RADIAL");
  has(cmodel::Table::Factor, "FACTOR");
  has(cmodel::Mode::Exponential, "exponential");
  has(cmodel::Mode::Additive, "additive");
  has(cmodel::Mode::Sum, "sum");
}

// S-rule-3.
TEST(StreamPage, RulesByNumber) {
  std::vector<std::vector<std::string>> rows;
  bool here = false;
  for (const std::string& line : lines_of("stream.md")) {
    here = here || line == "## Rules by number";
    if (here && line.rfind("| ", 0) == 0 && std::isdigit(static_cast<unsigned char>(line[2])) != 0)
      rows.push_back(cells(line));
  }
  std::size_t at = 0;
#define X(name, number, register_name, meaning)                                                      \
  if (cmodel::StreamRule::name != cmodel::StreamRule::None) {                                        \
    ASSERT_LT(at, rows.size());                                                                      \
    EXPECT_EQ(rows[at][0], std::to_string(number));                                                  \
    EXPECT_EQ(rows[at][1], lower(#register_name));                                                   \
    EXPECT_EQ(rows[at][2], meaning);                                                                 \
    EXPECT_EQ(rows[at][3].find("device") == 0, cmodel::checked_by_device(cmodel::StreamRule::name)); \
    ++at;                                                                                            \
  }
  FASTSPLAT_STREAM_RULES(X)
#undef X
  EXPECT_EQ(at, rows.size());
  std::printf("[figure] rules of the stream page held against the code = %zu (limit 20)\n", at);
  EXPECT_EQ(at, 20u);
}

/// Rows "| table.key | symbol | base | meaning |" of section 2.
std::vector<std::vector<std::string>> key_rows() {
  std::vector<std::vector<std::string>> rows;
  static const std::regex key(R"(\| [a-z]+\.[a-z_]+ \|[^|]*\|[^|]*\|[^|]*\|[^|]*\|)");
  for (const std::string& line : lines_of("numerics.md"))
    if (std::regex_match(line, key)) rows.push_back(cells(line));
  return rows;
}

bool may_be_absent(const std::vector<std::string>& row) { return row[4].ends_with("may be absent"); }

// N-2-1, N-2-3: keys, their order, limits and base values; optional keys.
TEST(NumericsPage, KeysAndBaseValuesAreTheConfigurations) {
  const auto rows = key_rows();
  const auto base = read_keys(std::string(FASTSPLAT_SOURCE_DIR) + "/configs/base.toml");
  const auto keys = cmodel::config_keys();
  ASSERT_EQ(rows.size(), keys.size());
  const std::size_t required = oracle::keys().size();
  std::vector<std::string> optional;
  for (const oracle::RoundingKey& key : oracle::rounding_keys()) optional.emplace_back(key.name);
  for (const char* key : {"rounding.carry", "index.kind", "index.symmetry", "ellipse.frac_bits", "composite.lanes",
                          "counters.bits", "composite.every_sample", "cull.map", "radial.interpolate",
                          "classify.segment_bits", "pattern.node_bits", "colour.int_bits"})
    optional.emplace_back(key);
  ASSERT_EQ(rows.size(), required + optional.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][0], keys[i].name) << "key " << i << " of the hash order";
    EXPECT_EQ(rows[i][0], i < required ? oracle::keys()[i].name : optional[i - required]);
    EXPECT_EQ(may_be_absent(rows[i]), i >= required) << rows[i][0];
    EXPECT_EQ(may_be_absent(rows[i]), keys[i].neutral.has_value()) << rows[i][0];
    EXPECT_EQ(rows[i][2], cmodel::text_of(named_config("base"), keys[i])) << rows[i][0];
    EXPECT_EQ(rows[i][3], cmodel::allowed(keys[i]) + (keys[i].power_of_two ? ", a power of two" : "")) << rows[i][0];
    if (may_be_absent(rows[i])) continue;
    ASSERT_TRUE(base.contains(rows[i][0])) << rows[i][0] << " is not in configs/base.toml";
    EXPECT_EQ(rows[i][2], base.at(rows[i][0])) << rows[i][0];
  }
  for (const auto& [key, value] : base) {
    if (key.find('.') == std::string::npos) continue;  // name, description, verified
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&name = key](const auto& row) { return row[0] == name; }))
        << key;
  }
  std::printf("[figure] configuration keys compared = %zu\n", rows.size());
}

// N-2-5, N-2-6.
TEST(NumericsPage, HashIsThatOfThePagesLines) {
  // From the page alone: its keys, its order, its base values.
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const auto& row : key_rows())
    for (const char c : may_be_absent(row) ? "" : row[0] + "=" + row[2] + "\n")
      hash = (hash ^ static_cast<unsigned char>(c)) * std::uint64_t{0x100000001b3U};
  EXPECT_EQ(hash, cmodel::config_hash(named_config("base")));
  for (const std::string& name : config_names()) {
    cmodel::Config config = named_config(name);
    const std::uint64_t expected = oracle::hash(symbols_of(config));
    EXPECT_EQ(cmodel::config_hash(config), expected) << name;
    config.name = config.description = config.verified = "other";
    EXPECT_EQ(cmodel::config_hash(config), expected) << name << ": names do not enter the hash";
  }
}

TEST(NumericsPage, NamesEveryCounterThatNeedsAMeaning) {
  std::string page;
  for (const std::string& line : lines_of("numerics.md")) page += line + '\n';
  cmodel::Counters{}.for_each([&](const std::string& name, std::uint64_t, const char*) {
    if (name == "tiles" || name == "sheets" || name == "splats" || name == "cull_blocks") return;  // plain counts
    EXPECT_NE(page.find(name), std::string::npos) << name;
  });
}

/// "CNT_TILES" -> 0, as the RTL gets them.
std::map<std::string, int> counter_numbers() {
  std::map<std::string, int> numbers;
  const std::string package = cmodel::sv_package(named_config("base"));
  static const std::regex number(R"(localparam int CNT_([A-Z_]+) = (\d+);)");
  for (std::sregex_iterator match(package.begin(), package.end(), number), end; match != end; ++match)
    numbers[lower((*match)[1].str())] = std::stoi((*match)[2].str());
  return numbers;
}

// M-register-15.
TEST(MicroarchitecturePage, NumbersEveryCounterAsThePackageDoes) {
  std::map<std::string, int> named;
  static const std::regex row(R"(\| \d+ \| [A-Za-z_]+ \|.*)");
  for (const std::string& line : lines_of("microarchitecture.md")) {
    if (!std::regex_match(line, row)) continue;
    const auto columns = cells(line);
    for (std::size_t i = 0; i + 1 < columns.size(); i += 2) named[lower(columns[i + 1])] = std::stoi(columns[i]);
  }
  const auto numbers = counter_numbers();
  std::printf("[figure] counters with number and address in the page = %zu (limit %zu)\n", named.size(),
              numbers.size());
  EXPECT_EQ(named, numbers);
  EXPECT_GT(named.size(), 16u);
}

/// Rows "| 0x14 | CONTROL | ... |" of the page's table of registers.
std::vector<std::vector<std::string>> register_rows() {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines_of("microarchitecture.md"))
    if (line.rfind("| 0x", 0) == 0) rows.push_back(cells(line));
  return rows;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(trimmed(part));
  return parts;
}

// M-register-5.
TEST(MicroarchitecturePage, NamesEveryRegisterAtItsAddressAndNoOther) {
  std::map<std::string, std::uint32_t> page, code;
  std::vector<std::uint32_t> counters;  // of the row of low words, and of that of high ones
  for (const auto& row : register_rows()) {
    const auto addresses = split(row[0]);
    if (addresses[0].ends_with(" + 8n")) {
      counters.push_back(static_cast<std::uint32_t>(std::stoul(addresses[0], nullptr, 16)));
      continue;
    }
    const auto names = split(row[1]);
    ASSERT_EQ(addresses.size(), names.size()) << row[0];
    for (std::size_t i = 0; i < names.size(); ++i)
      page[names[i]] = static_cast<std::uint32_t>(std::stoul(addresses[i], nullptr, 16));
  }
  for (const auto& reg : cmodel::kRegisters)
    if (reg.address != cmodel::kRegCounters.address) code[reg.name] = reg.address;
  for (const auto& one : cmodel::capabilities(named_config("base"))) code[one.reg.name] = one.reg.address;
  EXPECT_EQ(page, code);
  EXPECT_EQ(counters, (std::vector{cmodel::kRegCounters.address, cmodel::kRegCounters.address + 4}));
  std::printf("[figure] registers held against the code, the counters being one = %zu (limit 23)\n", page.size() + 1);
  EXPECT_EQ(page.size() + 1, 23u);
}

TEST(IntegrationPage, CountsEveryMemoryOfEachConfiguration) {
  const auto said = [](int instances, int words, int bits) {
    return std::to_string(instances) + " of " + std::to_string(words) + " x " + std::to_string(bits);
  };
  std::map<std::string, std::vector<std::string>> rows;
  for (const std::string& line : lines_of("integration.md")) {
    const auto columns = line.starts_with("| ") ? cells(line) : std::vector<std::string>{};
    if (columns.size() == 7) rows[columns[0]] = {columns.begin() + 4, columns.end()};
  }
  ASSERT_EQ(rows["memory"], (std::vector<std::string>{"`tiny`", "`small`", "`base`"}));
  std::size_t held = 0;
  for (const auto& [column, name] : {std::pair{0U, "tiny"}, {1U, "small"}, {2U, "base"}}) {
    const cmodel::Config c = named_config(name);
    const int lanes = c.lanes * c.lanes, blocks = c.tile_width * c.tile_height / lanes;
    const int sum = c.sheet_int_bits + c.sheet_frac_bits, state = std::max(sum, c.composite_frac_bits + 1);
    const int groups = static_cast<int>(std::bit_ceil(static_cast<unsigned>(c.rlut_columns / c.lanes)));
    const std::pair<const char*, std::string> expected[] = {
        {"sheet buffers, by bank", said(2 * lanes, blocks, 4 * sum)},
        {"picture, by bank", said(lanes, blocks, 4 * state)},
        {"RLUT of x and of y, by lane",
         said(2 * c.lanes, c.phases * groups, c.radial_index_bits() + c.rlut_guard_bits + 1)},
        {"radial table, by lane", said(lanes, c.radial_entries, c.weight_format().word_bits)},
        {"slab factor, by composite lane",
         said(c.composited_at_once(), c.opacity_segments, 2 * (c.opacity_frac_bits + 1))},
    };
    for (const auto& [memory, text] : expected) {
      ASSERT_EQ(rows[memory].size(), 3U) << memory;
      EXPECT_EQ(rows[memory][column], text) << memory << ", " << name;
      ++held;
    }
  }
  std::printf("[figure] memories of the page held against configurations = %zu (limit 15)\n", held);
  EXPECT_EQ(rows.size(), 6U) << "a memory that is not counted here";
}

/// A value as written; for a word, its place in the page's list "off, block or pixel".
int number_of(const std::string& limits, const std::string& text) {
  if (std::isdigit(static_cast<unsigned char>(text[0]))) return std::stoi(text);
  static const std::regex word("[a-z0-9_]+");
  int place = 0;
  for (std::sregex_iterator match(limits.begin(), limits.end(), word), end; match != end; ++match) {
    if (match->str() == "or" || match->str() == "of") continue;
    if (match->str() == text) return place;
    ++place;
  }
  ADD_FAILURE() << "'" << limits << "' lists no " << text;
  return 0;
}

/// The value of a word of the page: a symbol of numerics.md, section 2, or a key without a symbol, by its end.
int value_of(const cmodel::Config& config, const std::string& symbol) {
  for (const auto& row : key_rows()) {
    const std::string end = row[0].substr(row[0].find('.') + 1);
    if (row[1].substr(0, row[1].find(' ')) != symbol && !(row[1] == "-" && end == symbol)) continue;
    for (const auto& key : cmodel::config_keys())
      if (key.name == row[0]) return number_of(row[3], cmodel::text_of(config, key));
  }
  ADD_FAILURE() << "numerics.md knows no " << symbol;
  return 0;
}

// M-register-5, M-register-8.
TEST(MicroarchitecturePage, CapabilitiesArePackedAsTheirRowsSay) {
  static const std::regex field(R"((?:.* )?(\w+) in (?:bits )?(\d+)\.\.(\d+))");
  const auto rows = register_rows();
  std::vector<cmodel::Config> configs;
  for (const std::string& name : config_names()) configs.push_back(named_config(name));
  Random random(1);
  for (int i = 0; i < 20; ++i) configs.push_back(random_config(random));  // the others' tiles are as wide as high
  int fields = 0, words = 0;
  for (const cmodel::Config& config : configs) {
    for (const auto& [reg, word] : cmodel::capabilities(config)) {
      const auto row =
          std::find_if(rows.begin(), rows.end(), [&name = reg.name](const auto& one) { return one[1] == name; });
      ASSERT_NE(row, rows.end()) << reg.name;
      std::uint32_t expected = 0;
      for (const std::string& part : split((*row)[2])) {
        std::smatch match;
        ASSERT_TRUE(std::regex_match(part, match, field)) << reg.name << ": " << part;
        const int high = std::stoi(match[2]), low = std::stoi(match[3]);
        const auto value = static_cast<std::uint64_t>(value_of(config, match[1]));
        const std::uint64_t field_values = std::uint64_t{1} << (high - low + 1);
        EXPECT_LE(value, field_values) << reg.name << ", " << part;  // as many as there are: 0
        expected |= static_cast<std::uint32_t>(value % field_values) << low;
        ++fields;
      }
      EXPECT_EQ(word, expected) << reg.name << " of " << config.name;
      ++words;
    }
  }
  std::printf("[figure] capability words of all configurations = %d (limit > 0), their fields = %d\n", words, fields);
  EXPECT_GT(words, 0);
  EXPECT_EQ(fields * 12, words * 37);
}

/// Every file that the page names exists, and every numbered section of the numerics has a row.
TEST(RulesPage, NamesFilesThatAreThereAndEverySection) {
  static const std::regex path(R"(`([^` ]+/[^` ]*)`)"), section(R"(^##+ (\d(\.\d)?)\.? .*)"), number(R"(\d+(\.\d+)?)");
  std::set<std::string> rows;
  int paths = 0, sections = 0;
  for (const std::string& line : lines_of("rules.md")) {
    for (std::sregex_iterator match(line.begin(), line.end(), path), end; match != end; ++match, ++paths)
      EXPECT_TRUE(std::filesystem::exists(std::string(FASTSPLAT_SOURCE_DIR "/") + (*match)[1].str())) << (*match)[1];
    if (!line.starts_with("| numerics ")) continue;
    const std::string rule = cells(line)[0].substr(0, cells(line)[0].find(','));
    for (std::sregex_iterator match(rule.begin(), rule.end(), number), end; match != end; ++match)
      rows.insert(match->str());
  }
  std::smatch match;
  for (const std::string& line : lines_of("numerics.md")) {
    if (!std::regex_match(line, match, section)) continue;
    ++sections;
    EXPECT_TRUE(rows.contains(match[1].str())) << "no row for " << line;
  }
  std::printf("[figure] files named = %d (limit > 60), sections of the numerics = %d (limit > 15)\n", paths, sections);
  EXPECT_GT(paths, 60);
  EXPECT_GT(sections, 15);
}

/// The page suffices to connect the device: it lists every port of the top module (M-port-3, M-port-4, M-port-5,
/// M-port-8, M-port-10, M-tap-1).
TEST(MicroarchitecturePage, NamesEveryPort) {
  std::string page;
  for (const std::string& line : lines_of("microarchitecture.md")) page += line + '\n';
  std::ifstream file(FASTSPLAT_SOURCE_DIR "/rtl/fastsplat_core.sv");
  static const std::regex port(R"(^ +(input|output) +logic.* ([a-z_]+_n?[io]),?$)");
  int ports = 0;
  std::smatch match;
  for (std::string line; std::getline(file, line) && line != ");";) {
    if (!std::regex_match(line, match, port)) continue;
    ++ports;
    const std::string name = match[2];
    // "`tap_snap_valid_o`, `_tag_o[31:0]`": names after the first of a family omit its prefix.
    const auto part = name.rfind('_', name.size() - 3);
    const std::string tail = part == std::string::npos ? name : name.substr(part);
    EXPECT_TRUE(page.find("`" + name) != std::string::npos || page.find("`" + tail) != std::string::npos) << name;
  }
  std::printf("[figure] ports of the top module named in the page = %d (limit > 40)\n", ports);
  EXPECT_GT(ports, 40);
}

// Pages that tools/performance and tools/peers make contain the whole text of a file in tools/pages/benchmarks.
TEST(Documents, PagesOfFiguresHaveTheirPrefaces) {
  const auto text = [](const std::string& name) {
    std::ostringstream all;
    all << std::ifstream(std::string(FASTSPLAT_SOURCE_DIR) + "/" + name).rdbuf();
    return all.str();
  };
  for (const auto& [page, words] : {std::pair{"performance", "preface"}, {"peers", "peers_preface"}}) {
    const std::string preface = text(std::string("tools/pages/benchmarks/") + words + ".md");
    ASSERT_GT(preface.size(), 1000u) << words;
    EXPECT_NE(text(std::string("docs/") + page + ".md").find(preface), std::string::npos)
        << "./run " << page << " makes the page";
  }
}

TEST(Crc, KnownAnswer) {
  // The check value of CRC-32/ISO-HDLC (zlib's): the nine digits (S-file-6).
  const std::string digits = "123456789";
  EXPECT_EQ(oracle::crc32({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0xCBF43926U);
}

}  // namespace
}  // namespace fastsplat::test
