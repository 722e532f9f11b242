// harpoon-contract: writes what is generated from the AFU's contract, the SystemVerilog package and
// the register map of the docs, or checks that what is there is what it would write. Holds no
// constant of its own.
//
//   harpoon-contract [--check] PACKAGE.sv REGISTERS.md

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "device/afu/contract.hpp"

namespace {

namespace contract = harpoon::afu::contract;

/// What a type of the contract is called in SystemVerilog: `suffix` is "_t" or "_e".
std::string identifier(std::string_view name, std::string_view suffix = {}) {
  std::string text;
  for (const char c : name) {
    text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text.append(suffix);
}

/// The name of a member; the language has some words for itself.
std::string member_name(std::string_view name) {
  return identifier(name, name == "CONFIG" || name == "SEQUENCE" ? "_word" : "");
}

/// The type of a field or of bits: a struct, an enum, or (`name` empty) a number.
std::string type_of(std::string_view name, std::uint32_t width) {
  if (name.empty()) return width == 1 ? "logic" : fmt::format("logic [{}:0]", width - 1);
  const bool is_code = std::ranges::any_of(
      contract::kCodes, [&](const contract::Codes& codes) { return codes.name == name; });
  return identifier(name, is_code ? "_e" : "_t");
}

/// Neighbouring bits of a packed struct.
struct Member {
  std::string name;
  std::uint32_t low;
  std::uint32_t width;
  std::string type;
};

/// Text of the package, line by line.
class Package {
 public:
  void line(std::string_view text) { text_.append(text).push_back('\n'); }
  void bits(std::string_view name, unsigned width, std::uint64_t value) {
    line(fmt::format("  localparam logic [{}:0] {} = {}'h{:x};", width - 1, name, width, value));
  }
  void number(std::string_view name, std::uint64_t value) {
    line(fmt::format("  localparam int unsigned {} = {};", name, value));
  }
  void codes(const contract::Codes& codes) {
    line(fmt::format("\n  typedef enum logic [{}:0] {{", codes.bits - 1));
    for (const contract::Code& code : codes.codes) {
      line(fmt::format("    {}_{} = {}'h{:x}{}", codes.name, code.name, codes.bits, code.value,
                       &code == &codes.codes.back() ? "" : ","));
    }
    line(fmt::format("  }} {};", identifier(codes.name, "_e")));
  }
  /// `members` from the lowest, `width` bits in all; what lies between them is zero.
  void packed(std::string_view name, const std::vector<Member>& members, std::uint32_t width) {
    line("\n  typedef struct packed {");
    std::uint32_t top = width;
    for (auto member = members.rbegin(); member != members.rend(); ++member) {
      gap(member->low + member->width, top);
      line(fmt::format("    {} {};", member->type, member->name));
      top = member->low;
    }
    gap(0, top);
    line(fmt::format("  }} {};", identifier(name, "_t")));
  }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  void gap(std::uint32_t low, std::uint32_t top) {
    if (low != top) line(fmt::format("    {} zero_{};", type_of({}, top - low), low));
  }

  std::string text_;
};

void put_limits(Package& out) {
  out.number("MAX_PAGES", contract::kMaxPages);
  out.number("PAIRS_PER_LINE", contract::kPairsPerLine);
  out.number("INDEX_PAIRS_PER_LINE", contract::kIndexPairsPerLine);
  out.bits("AFU_ID_LOW", 64, contract::kAfuIdLow);
  out.bits("AFU_ID_HIGH", 64, contract::kAfuIdHigh);
  out.bits("SPL_ID", 32, contract::kSplId);
  out.bits("CHECK_SEED", 64, contract::kCheckSeed);
  out.bits("FORMAT_COUNT", 32, contract::kFormatCount);
  out.bits("CONTROL_GO", 8, contract::control::kGo);
}

void put_places(Package& out) {
  out.bits("SPL_DSM_ID_LINE", 6, contract::kSplDsmIdLine);
  out.bits("SPL_DSM_FAULT_LINE", 6, contract::kSplDsmFaultLine);
  out.bits("DSM_ID_LINE", 6, contract::kDsmIdLine);
  out.bits("DSM_LATENCY_LINE", 6, contract::kDsmLatencyLine);
  out.bits("DSM_PERFORMANCE_LINE", 6, contract::kDsmPerformanceLine);
  out.bits("STATUS_LINE", 58, contract::vafu2_cntxt::kStatusOffset / contract::kLineBytes);
  out.bits("CONTROL_LINE", 58, contract::vafu2_cntxt::kControlOffset / contract::kLineBytes);
}

void put_words(Package& out) {
  for (const contract::Word& word : contract::kWords) {
    std::vector<Member> members;
    for (const contract::Bits& bits : word.bits) {
      members.push_back(
          {member_name(bits.name), bits.low, bits.count, type_of(bits.type, bits.count)});
    }
    out.packed(word.name, members, word.bytes * 8);
  }
}

void put_records(Package& out) {
  for (const contract::Record& record : contract::kRecords) {
    std::vector<Member> members;
    for (const contract::Field& field : record.fields) {
      members.push_back({member_name(field.name), field.offset * 8, field.bytes * 8,
                         type_of(field.type, field.bytes * 8)});
    }
    out.packed(record.name, members, record.bytes * 8);
  }
}

std::string package() {
  Package out;
  out.line("// Generated by harpoon-contract from device/afu/contract.hpp; do not edit.");
  out.line("//");
  out.line(
      "// Registers, records, formats, limits and codes of the AFU. A record or a register is a");
  out.line(
      "// packed struct, first field in the low bits, as it travels; what has no meaning is "
      "called");
  out.line("// zero_N, N the place of its lowest bit. *_LINE counts lines of 64 bytes.");
  out.line("package harpoon_contract_pkg;");
  put_limits(out);
  put_places(out);
  std::vector<contract::Code> offsets;
  for (const contract::Register& r : contract::kRegisters) offsets.push_back({r.name, r.offset});
  out.codes({"REG", 16, offsets});
  for (const contract::Codes& codes : contract::kCodes) out.codes(codes);
  put_words(out);
  put_records(out);
  out.line("endpackage");
  return out.text();
}

/// " (bits 0 START: meaning; 7:4 CODE)" for a word, nothing for another type.
std::string bits_of(std::string_view type) {
  std::string text;
  for (const contract::Word& word : contract::kWords) {
    if (word.name != type) continue;
    for (const contract::Bits& bits : word.bits) {
      if (!text.empty()) text += "; ";
      if (bits.count > 1) text += fmt::format("{}:", bits.low + bits.count - 1);
      text += fmt::format("{} {}", bits.low, bits.name);
      if (!bits.meaning.empty()) text += fmt::format(": {}", bits.meaning);
    }
    const bool is_one = word.bits.size() == 1 && word.bits[0].count == 1;
    return fmt::format(" ({} {})", is_one ? "bit" : "bits", text);
  }
  return text;
}

/// Addresses have the same bits everywhere, told once.
std::string meaning_of(std::string_view meaning, std::string_view type) {
  const bool is_address = type == "LINE_ADDRESS" || type == "PAGE_ADDRESS";
  return std::string(meaning) + (is_address ? "" : bits_of(type));
}

std::string register_map() {
  std::string out =
      "<!-- Generated by harpoon-contract from device/afu/contract.hpp; do not edit. -->\n"
      "# AFU register and record map\n\n"
      "64-bit registers take two 32-bit writes, the high half first (offset + 4); the low half\n"
      "commits. All records are little-endian.\n\n"
      "| offset | bytes | register | access | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const contract::Register& r : contract::kRegisters) {
    out += fmt::format("| 0x{:04X} | {} | {} | {} | {} |\n", r.offset, r.bytes, r.name, r.access,
                       meaning_of(r.meaning, r.type));
  }
  for (const contract::Record& record : contract::kRecords) {
    out += fmt::format(
        "\n## {}\n{}.\n\n| byte | bytes | field | meaning |\n| --- | --- | --- | --- |\n",
        record.name, record.place);
    for (const contract::Field& field : record.fields) {
      out += fmt::format("| {} | {} | {} | {} |\n", field.offset, field.bytes, field.name,
                         meaning_of(field.meaning, field.type));
    }
  }
  return out;
}

/// Writes a file, or compares it with what it should hold.
bool settle(bool checking, const char* path, const std::string& text) {
  if (checking) {
    std::ifstream in(path, std::ios::binary);
    if (std::string{std::istreambuf_iterator<char>(in), {}} == text) return true;
    fmt::print(stderr, "stale: {}\n", path);
    return false;
  }
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (out.flush()) return true;
  fmt::print(stderr, "harpoon-contract: cannot write {}\n", path);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const bool checking = argc == 4 && std::string_view(argv[1]) == "--check";
  if (argc != 3 && !checking) {
    fmt::print(stderr, "usage: harpoon-contract [--check] PACKAGE.sv REGISTERS.md\n");
    return 2;
  }
  const bool package_good = settle(checking, argv[argc - 2], package());
  const bool map_good = settle(checking, argv[argc - 1], register_map());
  return package_good && map_good ? 0 : 1;
}
