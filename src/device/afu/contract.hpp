#pragma once

// The contract between the AFU's host half and its RTL: register offsets, record layouts, formats,
// limits and error codes. The only place where they are written down: the SystemVerilog package
// harpoon_contract_pkg and the register map in the docs are generated from it by harpoon-contract
// (src/hls/contract.cpp). Constants only: no behaviour, no I/O. What has fields or bits becomes a
// packed struct there, codes become an enum.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace harpoon::afu::contract {

// ---- Lines, pages, limits ----------------------------------------------------------------------

/// Everything travels in lines of 64 bytes, little-endian.
inline constexpr std::uint32_t kLineBytes = 64;
inline constexpr std::uint32_t kWordsPerLine = 8;  ///< 64-bit words
/// SPL2 translates pages of 2 MB; one page-table entry per line, 1 to 1024 entries: 2 GB.
inline constexpr std::uint32_t kPageShift = 21;
inline constexpr std::uint64_t kPageBytes = std::uint64_t{1} << kPageShift;
inline constexpr std::uint32_t kMaxPages = 1024;
inline constexpr std::uint64_t kMaxWorkspaceBytes = kMaxPages * kPageBytes;

inline constexpr std::uint32_t kPairBytes = 32;     ///< p1.xyz r1 p2.xyz r2
inline constexpr std::uint32_t kContactBytes = 32;  ///< pos.xyz normal.xyz depth word7
inline constexpr std::uint32_t kSphereBytes = 16;   ///< xyz r
inline constexpr std::uint32_t kPairsPerLine = kLineBytes / kPairBytes;
inline constexpr std::uint32_t kContactsPerLine = kLineBytes / kContactBytes;
inline constexpr std::uint32_t kSpheresPerLine = kLineBytes / kSphereBytes;
inline constexpr std::uint32_t kIndexPairBytes = 4;
inline constexpr std::uint32_t kIndexPairsPerLine = kLineBytes / kIndexPairBytes;

// ---- Identity ----------------------------------------------------------------------------------

inline constexpr std::uint64_t kAfuIdLow = 0x9d3c'48a1'7f20'e6b5;
inline constexpr std::uint64_t kAfuIdHigh = 0x4841'5250'4f4f'4e01;  ///< "HARPOON", version 1
inline constexpr std::uint32_t kSplId = 0x1110'0101;

// ---- Formats -----------------------------------------------------------------------------------

/// What Src holds and what comes back in Dst.
enum class Format : std::uint32_t {
  direct = 0,       ///< 2 pairs a line in; one result per pair, 2 a line, in pair order
  direct_hits = 1,  ///< 2 pairs a line in; hits only, in pair order, with their pair number
  indexed_hits = 2  ///< sphere table, 16 index pairs a line in; hits only, as above
};
inline constexpr std::uint32_t kFormatCount = 3;
inline constexpr std::uint32_t kFlowFake = 1;
inline constexpr std::uint32_t kFlowGrazing = 2;
inline constexpr std::uint32_t kFlowReal = 3;

/// Named values of a number of `bits` bits: an enum of the RTL.
struct Code {
  std::string_view name;
  std::uint32_t value;
};
struct Codes {
  std::string_view name;
  std::uint32_t bits;
  std::span<const Code> codes;
};
template <class Enum>
constexpr Code code(std::string_view name, Enum value) {
  return {name, static_cast<std::uint32_t>(value)};
}

inline constexpr auto kFormatCodes =
    std::to_array<Code>({code("DIRECT", Format::direct), code("DIRECT_HITS", Format::direct_hits),
                         code("INDEXED_HITS", Format::indexed_hits)});
inline constexpr auto kFlowCodes =
    std::to_array<Code>({{"FAKE", kFlowFake}, {"GRAZING", kFlowGrazing}, {"REAL", kFlowReal}});

// ---- Faults and errors -------------------------------------------------------------------------

/// SPL2 faults, terminal until reset. Reported in the SPL2 DSM, line 1, and in SPL2_FAULT.
enum class Spl2Fault : std::uint32_t {
  none = 0,
  pte_load_error = 1,      ///< SPL2_CNTXT or page table invalid, corrupt, or not readable
  access_violation = 2,    ///< an address outside the workspace, or a page without a valid entry
  bus_error = 3,           ///< the memory answered a request with an error response
  unexpected_response = 4  ///< a response that belongs to no request
};
inline constexpr std::uint32_t kRequestRead = 1;
inline constexpr std::uint32_t kRequestWrite = 2;

inline constexpr auto kFaultCodes = std::to_array<Code>(
    {code("NONE", Spl2Fault::none), code("PTE_LOAD", Spl2Fault::pte_load_error),
     code("ACCESS", Spl2Fault::access_violation), code("BUS", Spl2Fault::bus_error),
     code("UNEXPECTED", Spl2Fault::unexpected_response)});
inline constexpr auto kRequestCodes =
    std::to_array<Code>({{"NONE", 0}, {"READ", kRequestRead}, {"WRITE", kRequestWrite}});

/// Errors that the PUC reports in Status, after an orderly end of the transaction.
enum class AfuError : std::uint32_t {
  none = 0,
  bad_context = 1,        ///< VAFU2_CNTXT does not match its check word
  bad_control = 2,        ///< the control line does not match its check word
  bad_format = 3,         ///< unknown format
  source_too_short = 4,   ///< n_col needs more lines than num_cl
  too_many_spheres = 5,   ///< more spheres than the table holds
  index_out_of_range = 6  ///< an index pair names a sphere that was not loaded; Dst is void
};

inline constexpr auto kErrorCodes = std::to_array<Code>(
    {code("NONE", AfuError::none), code("BAD_CONTEXT", AfuError::bad_context),
     code("BAD_CONTROL", AfuError::bad_control), code("BAD_FORMAT", AfuError::bad_format),
     code("SOURCE_TOO_SHORT", AfuError::source_too_short),
     code("TOO_MANY_SPHERES", AfuError::too_many_spheres),
     code("INDEX", AfuError::index_out_of_range)});

inline constexpr auto kCodes = std::to_array<Codes>({{"FORMAT", 32, kFormatCodes},
                                                     {"FLOW", 32, kFlowCodes},
                                                     {"FAULT", 4, kFaultCodes},
                                                     {"REQUEST", 4, kRequestCodes},
                                                     {"ERROR", 4, kErrorCodes}});

// ---- Words of named bits -----------------------------------------------------------------------

/// Neighbouring bits of a word, from the lowest.
struct Bits {
  std::string_view name;
  std::uint32_t low;
  std::uint32_t count;
  std::string_view meaning;
  std::string_view type = {};  ///< of kCodes, or a number
};
constexpr std::uint32_t mask(const Bits& bits) {
  return ((1u << bits.count) - 1) << bits.low;
}

/// A word whose bits have names; the others are zero.
struct Word {
  std::string_view name;
  std::uint32_t bytes;
  std::span<const Bits> bits;
};

inline constexpr auto kApCtrlBits =
    std::to_array<Bits>({{"START", 0, 1, "the same as enable in SPL2_CH_CTRL"},
                         {"DONE", 1, 1, "cleared by the read"},
                         {"IDLE", 2, 1, ""},
                         {"READY", 3, 1, ""}});
inline constexpr auto kConfigBits = std::to_array<Bits>(
    {{"SCPUS", 0, 8, ""}, {"IN_FLIGHT", 8, 8, "most lines"}, {"LANES", 16, 8, "index lanes"}});
inline constexpr auto kPucModeBits =
    std::to_array<Bits>({{"BATCH_BARRIER", 0, 1, "N pairs at a time, as published"}});
inline constexpr auto kSpl2FaultBits =
    std::to_array<Bits>({{"VALID", 0, 1, ""},
                         {"CODE", 4, 4, "Spl2Fault", "FAULT"},
                         {"REQUEST", 8, 4, "1 read, 2 write", "REQUEST"}});
inline constexpr auto kStateBits = std::to_array<Bits>({{"PUC", 0, 4, "state"},
                                                        {"SPL2", 4, 4, "state"},
                                                        {"READS", 8, 8, "outstanding"},
                                                        {"WRITES", 16, 8, "outstanding"}});
inline constexpr auto kChCtrlBits = std::to_array<Bits>(
    {{"RESET", 0, 1, "drains the bus, ends by itself"}, {"ENABLE", 1, 1, "start the transaction"}});
inline constexpr auto kLineAddressBits =
    std::to_array<Bits>({{"OFFSET", 0, 6, "in the line"}, {"LINE", 6, 58, ""}});
inline constexpr auto kPageAddressBits =
    std::to_array<Bits>({{"OFFSET", 0, 21, "in the page"}, {"PAGE", 21, 43, ""}});
inline constexpr auto kPageSizeBits = std::to_array<Bits>({{"TWO_MB", 0, 1, "the only size"}});
inline constexpr auto kAddressModeBits =
    std::to_array<Bits>({{"IS_VIRTUAL", 0, 1, "the only mode"}});
inline constexpr auto kPageEntryBits =
    std::to_array<Bits>({{"VALID", 0, 1, ""}, {"PAGE", 21, 43, "physical"}});
inline constexpr auto kCompletionBits =
    std::to_array<Bits>({{"DONE", 0, 1, ""}, {"FAILED", 1, 1, ""}});
inline constexpr auto kErrorBits = std::to_array<Bits>({{"CODE", 0, 4, "AfuError", "ERROR"}});
inline constexpr auto kFaultBits = std::to_array<Bits>({{"CODE", 0, 4, "Spl2Fault", "FAULT"}});
inline constexpr auto kRequestBits =
    std::to_array<Bits>({{"CODE", 0, 4, "1 read, 2 write", "REQUEST"}});
inline constexpr auto kTableBits = std::to_array<Bits>({{"LOAD", 0, 1, "load the table first"}});
inline constexpr auto kHitBits =
    std::to_array<Bits>({{"NUMBER", 0, 31, "of the pair"}, {"GRAZING", 31, 1, ""}});

inline constexpr auto kWords = std::to_array<Word>({
    {"AP_CTRL", 4, kApCtrlBits},
    {"CONFIG", 4, kConfigBits},
    {"PUC_MODE", 4, kPucModeBits},
    {"SPL2_FAULT", 4, kSpl2FaultBits},
    {"STATE", 4, kStateBits},
    {"SPL2_CH_CTRL", 4, kChCtrlBits},
    {"LINE_ADDRESS", 8, kLineAddressBits},
    {"PAGE_ADDRESS", 8, kPageAddressBits},
    {"PAGE_SIZE", 4, kPageSizeBits},
    {"ADDRESS_MODE", 4, kAddressModeBits},
    {"PAGE_ENTRY", 8, kPageEntryBits},
    {"COMPLETION", 4, kCompletionBits},
    {"ERROR_WORD", 4, kErrorBits},
    {"FAULT_WORD", 4, kFaultBits},
    {"REQUEST_WORD", 4, kRequestBits},
    {"TABLE_WORD", 4, kTableBits},
    {"HIT_WORD", 4, kHitBits},
});

// ---- Registers ---------------------------------------------------------------------------------

inline constexpr std::uint32_t kRegApCtrl = 0x0000;
inline constexpr std::uint32_t kRegAfuId0 = 0x0010;
inline constexpr std::uint32_t kRegAfuId1 = 0x0014;
inline constexpr std::uint32_t kRegAfuId2 = 0x0018;
inline constexpr std::uint32_t kRegAfuId3 = 0x001c;
inline constexpr std::uint32_t kRegConfig = 0x0020;
inline constexpr std::uint32_t kRegTableSpheres = 0x0024;
inline constexpr std::uint32_t kRegInFlight = 0x0028;
inline constexpr std::uint32_t kRegPucMode = 0x002c;
inline constexpr std::uint32_t kRegSpl2Fault = 0x0030;
inline constexpr std::uint32_t kRegFaultAddressLow = 0x0034;
inline constexpr std::uint32_t kRegFaultAddressHigh = 0x0038;
inline constexpr std::uint32_t kRegAfuError = 0x003c;
inline constexpr std::uint32_t kRegState = 0x0040;
inline constexpr std::uint32_t kRegSplDsmBase = 0x1000;
inline constexpr std::uint32_t kRegSpl2CntxtBase = 0x1008;
inline constexpr std::uint32_t kRegSpl2ChCtrl = 0x1010;
inline constexpr std::uint32_t kRegAfuDsmBase = 0x8a00;
inline constexpr std::uint32_t kRegAfuCntxtBase = 0x8a08;

inline constexpr std::uint32_t kApStart = mask(kApCtrlBits[0]);
inline constexpr std::uint32_t kApDone = mask(kApCtrlBits[1]);
inline constexpr std::uint32_t kApIdle = mask(kApCtrlBits[2]);
inline constexpr std::uint32_t kApReady = mask(kApCtrlBits[3]);
inline constexpr std::uint32_t kChReset = mask(kChCtrlBits[0]);
inline constexpr std::uint32_t kChEnable = mask(kChCtrlBits[1]);
inline constexpr std::uint32_t kModeBatchBarrier = mask(kPucModeBits[0]);
/// Word 7 of a result: `direct` has the flow (1, 2 or 3), the hits-only formats HIT_WORD.
inline constexpr std::uint32_t kGrazingBit = kHitBits[1].low;

struct Register {
  std::uint32_t offset;
  std::uint32_t bytes;
  std::string_view name;
  std::string_view access;
  std::string_view meaning;
  std::string_view type = {};  ///< of kWords, or a number
};

inline constexpr auto kRegisters = std::to_array<Register>({
    {kRegApCtrl, 4, "AP_CTRL", "RW", "control of an XRT kernel", "AP_CTRL"},
    {kRegAfuId0, 4, "AFU_ID_0", "RO", "AFU ID, bits 31:0"},
    {kRegAfuId1, 4, "AFU_ID_1", "RO", "AFU ID, bits 63:32"},
    {kRegAfuId2, 4, "AFU_ID_2", "RO", "AFU ID, bits 95:64"},
    {kRegAfuId3, 4, "AFU_ID_3", "RO", "AFU ID, bits 127:96"},
    {kRegConfig, 4, "CONFIG", "RO", "what was built", "CONFIG"},
    {kRegTableSpheres, 4, "TABLE_SPHERES", "RO", "spheres that the on-chip table holds"},
    {kRegInFlight, 4, "IN_FLIGHT", "RW",
     "most lines in flight each way; kept over CH_CTRL reset; capped by CONFIG"},
    {kRegPucMode, 4, "PUC_MODE", "RW", "kept over CH_CTRL reset", "PUC_MODE"},
    {kRegSpl2Fault, 4, "SPL2_FAULT", "RO", "the fault since the last reset", "SPL2_FAULT"},
    {kRegFaultAddressLow, 4, "FAULT_ADDRESS_LO", "RO", "address of the fault, bits 31:0"},
    {kRegFaultAddressHigh, 4, "FAULT_ADDRESS_HI", "RO", "address of the fault, bits 63:32"},
    {kRegAfuError, 4, "AFU_ERROR", "RO", "error code of the last transaction, as in Status"},
    {kRegState, 4, "STATE", "RO", "what the AFU is doing", "STATE"},
    {kRegSplDsmBase, 8, "SPL_DSM_BASE", "WO", "physical address; the commit writes SPL_ID there",
     "LINE_ADDRESS"},
    {kRegSpl2CntxtBase, 8, "SPL2_CNTXT_BASE", "WO", "physical address of SPL2_CNTXT",
     "LINE_ADDRESS"},
    {kRegSpl2ChCtrl, 4, "SPL2_CH_CTRL", "WO", "control of SPL2", "SPL2_CH_CTRL"},
    {kRegAfuDsmBase, 8, "AFU_DSM_BASE", "WO", "physical address; the commit writes AFU_ID there",
     "LINE_ADDRESS"},
    {kRegAfuCntxtBase, 8, "AFU_CNTXT_BASE", "WO", "workspace address of VAFU2_CNTXT",
     "LINE_ADDRESS"},
});

// ---- Records in memory -------------------------------------------------------------------------

/// A little-endian number inside a record.
struct Field {
  std::string_view name;
  std::uint32_t offset;  ///< bytes
  std::uint32_t bytes;
  std::string_view meaning;
  std::string_view type = {};  ///< of kWords, kCodes or kRecords, or a number
};

/// Lines that steer the device carry a check word: kCheckSeed ^ line_fold(words 0 to 6). A line
/// that arrives with up to three wrong bits never matches it.
inline constexpr std::uint64_t kCheckSeed = 0x5ca1'ab1e'0ddb'a115;
inline constexpr std::uint32_t kCheckOffset = 56;

namespace spl2_cntxt {  ///< 64 bytes at SPL2_CNTXT_BASE
inline constexpr Field kPageTable{"PAGE_TABLE", 0, 8, "physical address of the page table",
                                  "LINE_ADDRESS"};
inline constexpr Field kAfuContext{"AFU_CONTEXT", 8, 8, "workspace base (virtual, 2 MB aligned)",
                                   "PAGE_ADDRESS"};
inline constexpr Field kPageSize{"PAGE_SIZE", 16, 4, "of all pages", "PAGE_SIZE"};
inline constexpr Field kPageCount{"PAGE_COUNT", 20, 4, "number of entries, 1 to 1024"};
inline constexpr Field kControl{"CONTROL", 24, 4, "how addresses are meant", "ADDRESS_MODE"};
inline constexpr Field kHandle{"HANDLE", 32, 8, "for software"};
inline constexpr Field kAfuDsm{"AFU_DSM", 40, 8, "physical address of the AFU DSM"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>(
    {kPageTable, kAfuContext, kPageSize, kPageCount, kControl, kHandle, kAfuDsm, kCheck});
}  // namespace spl2_cntxt

namespace pte {  ///< one line per entry
inline constexpr Field kEntry{"ENTRY", 0, 8, "the translation", "PAGE_ENTRY"};
inline constexpr Field kIndex{"INDEX", 8, 4, "its own place in the table"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>({kEntry, kIndex, kCheck});
}  // namespace pte

namespace vafu2_cntxt {  ///< 128 bytes at AFU_CNTXT_BASE, then the control line
inline constexpr Field kSource{"SOURCE", 8, 8, "Src: pairs or index pairs", "LINE_ADDRESS"};
inline constexpr Field kDest{"DEST", 16, 8, "Dst: results", "LINE_ADDRESS"};
inline constexpr Field kSourceLines{"SOURCE_LINES", 24, 4, "num_cl: lines in Src"};
inline constexpr Field kDestLines{"DEST_LINES", 28, 4, "lines in Dst; nothing is written beyond"};
inline constexpr Field kSpheres{"SPHERES", 32, 8, "sphere array (indexed format)", "LINE_ADDRESS"};
inline constexpr Field kSphereCount{"SPHERE_COUNT", 40, 4, "spheres to load (indexed format)"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>(
    {kSource, kDest, kSourceLines, kDestLines, kSpheres, kSphereCount, kCheck});
inline constexpr std::uint32_t kStatusOffset = 64;    ///< the Status line
inline constexpr std::uint32_t kControlOffset = 128;  ///< the control memory
inline constexpr std::uint32_t kBytes = 192;
}  // namespace vafu2_cntxt

namespace status {  ///< the line at VAFU2_CNTXT + 64
inline constexpr Field kStatus{"STATUS", 0, 4, "how it ended", "COMPLETION"};
inline constexpr Field kError{"ERROR", 4, 4, "what was wrong", "ERROR_WORD"};
inline constexpr Field kSequence{"SEQUENCE", 8, 4, "copied from the control line"};
inline constexpr Field kHits{"HITS", 12, 4,
                             "hits found (hits-only formats: also those not written)"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>({kStatus, kError, kSequence, kHits, kCheck});
inline constexpr std::uint32_t kDone = mask(kCompletionBits[0]);
inline constexpr std::uint32_t kFailed = mask(kCompletionBits[1]);
}  // namespace status

namespace control {  ///< control memory, the line at VAFU2_CNTXT + 128
inline constexpr Field kStart{"START", 0, 1, "0xFF = start; written last"};
inline constexpr Field kReset{"RESET", 1, 1, "0xFF, without START = forget the sphere table"};
inline constexpr Field kPairCount{"PAIR_COUNT", 4, 4, "n_col"};
inline constexpr Field kFormat{"FORMAT", 8, 4, "Format", "FORMAT"};
inline constexpr Field kSequence{"SEQUENCE", 12, 4, "number of the transaction"};
inline constexpr Field kLoadTable{"LOAD_TABLE", 16, 4, "what to do with the sphere table",
                                  "TABLE_WORD"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields =
    std::to_array<Field>({kStart, kReset, kPairCount, kFormat, kSequence, kLoadTable, kCheck});
inline constexpr std::uint32_t kGo = 0xff;
}  // namespace control

// The device status memories: lines of the 4 KB pages at SPL_DSM_BASE and AFU_DSM_BASE.
inline constexpr std::uint32_t kDsmBytes = 4096;
inline constexpr std::uint32_t kSplDsmIdLine = 0;
inline constexpr std::uint32_t kSplDsmFaultLine = 1;
inline constexpr std::uint32_t kDsmIdLine = 0;
inline constexpr std::uint32_t kDsmLatencyLine = 4;
inline constexpr std::uint32_t kDsmPerformanceLine = 5;
inline constexpr std::uint32_t kDsmScratchLine = 63;

namespace spl_fault {  ///< SPL2 DSM line 1
inline constexpr Field kValid{"VALID", 0, 1, "1: this line is valid"};
inline constexpr Field kError{"ERROR", 1, 1, "1: a fault"};
inline constexpr Field kStatus{"STATUS", 4, 4, "the fault", "FAULT_WORD"};
inline constexpr Field kRequest{"REQUEST", 8, 4, "what was asked for", "REQUEST_WORD"};
inline constexpr Field kAddress{"ADDRESS", 16, 8, "address of the request", "LINE_ADDRESS"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields =
    std::to_array<Field>({kValid, kError, kStatus, kRequest, kAddress, kCheck});
}  // namespace spl_fault

namespace dsm_id {  ///< AFU DSM line 0
inline constexpr Field kLow{"LOW", 0, 8, "AFU ID, low word"};
inline constexpr Field kHigh{"HIGH", 8, 8, "AFU ID, high word"};
inline constexpr Field kConfig{"CONFIG", 16, 4, "as the register", "CONFIG"};
inline constexpr Field kTableSpheres{"TABLE_SPHERES", 20, 4, "as the register"};
inline constexpr Field kSequence{"SEQUENCE", 24, 4, "transaction; 0 before the first"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields =
    std::to_array<Field>({kLow, kHigh, kConfig, kTableSpheres, kSequence, kCheck});
}  // namespace dsm_id

namespace dsm_latency {  ///< AFU DSM line 4; cycles count from the start signal
inline constexpr Field kSequence{"SEQUENCE", 0, 4, "transaction"};
inline constexpr Field kFirstLine{"FIRST_LINE", 4, 4, "cycles to the first line of Src or spheres"};
inline constexpr Field kFirstWrite{"FIRST_WRITE", 8, 4, "cycles to the first line to Dst"};
inline constexpr Field kLastWrite{"LAST_WRITE", 12, 4, "cycles to the last acknowledged result"};
inline constexpr Field kReadStalls{"READ_STALLS", 16, 4,
                                   "cycles in which a read waited for a slot"};
inline constexpr Field kWriteStalls{"WRITE_STALLS", 20, 4, "cycles in which a result line waited"};
inline constexpr Field kSpl2Cycles{"SPL2_CYCLES", 24, 4, "cycles from enable to the start signal"};
inline constexpr Field kSphereCount{"SPHERE_COUNT", 28, 4, "spheres in the table"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields =
    std::to_array<Field>({kSequence, kFirstLine, kFirstWrite, kLastWrite, kReadStalls, kWriteStalls,
                          kSpl2Cycles, kSphereCount, kCheck});
}  // namespace dsm_latency

namespace dsm_performance {  ///< AFU DSM line 5
inline constexpr Field kCycles{"CYCLES", 0, 4, "cycles from the start signal to these counters"};
inline constexpr Field kSequence{"SEQUENCE", 4, 4, "transaction"};
inline constexpr Field kLinesRead{"LINES_READ", 8, 4, "lines of Src and spheres"};
inline constexpr Field kLinesWritten{"LINES_WRITTEN", 12, 4, "lines of Dst"};
inline constexpr Field kHits{"HITS", 16, 4, "hits"};
inline constexpr Field kScpuPairs{"SCPU_PAIRS", 20, 4, "pairs that went through an SCPU"};
inline constexpr Field kSourceDigest{"SOURCE_DIGEST", 24, 8, "digest of all lines read, in order"};
inline constexpr Field kDestDigest{"DEST_DIGEST", 32, 8, "digest of all lines written, in order"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields =
    std::to_array<Field>({kCycles, kSequence, kLinesRead, kLinesWritten, kHits, kScpuPairs,
                          kSourceDigest, kDestDigest, kCheck});
}  // namespace dsm_performance

// What Src, Dst and the sphere array hold.
namespace sphere {
inline constexpr auto kFields = std::to_array<Field>(
    {{"X", 0, 4, "centre, binary32"}, {"Y", 4, 4, ""}, {"Z", 8, 4, ""}, {"R", 12, 4, "radius"}});
}  // namespace sphere

namespace pair {
inline constexpr auto kFields =
    std::to_array<Field>({{"P1", 0, 16, "", "SPHERE"}, {"P2", 16, 16, "", "SPHERE"}});
}  // namespace pair

namespace pair_line {
inline constexpr auto kFields =
    std::to_array<Field>({{"FIRST", 0, 32, "", "PAIR"}, {"SECOND", 32, 32, "", "PAIR"}});
}  // namespace pair_line

namespace index_pair {
inline constexpr auto kFields =
    std::to_array<Field>({{"P1", 0, 2, "place in the sphere array"}, {"P2", 2, 2, ""}});
}  // namespace index_pair

namespace contact {
inline constexpr Field kPosX{"POS_X", 0, 4, "binary32"};
inline constexpr Field kPosY{"POS_Y", 4, 4, ""};
inline constexpr Field kPosZ{"POS_Z", 8, 4, ""};
inline constexpr Field kNormalX{"NORMAL_X", 12, 4, ""};
inline constexpr Field kNormalY{"NORMAL_Y", 16, 4, ""};
inline constexpr Field kNormalZ{"NORMAL_Z", 20, 4, ""};
inline constexpr Field kDepth{"DEPTH", 24, 4, ""};
inline constexpr Field kFlow{"FLOW", 28, 4, "1 no hit, 2 grazing, 3 real", "FLOW"};
inline constexpr Field kHit{"HIT", 28, 4, "which pair it is", "HIT_WORD"};
inline constexpr auto kFields =
    std::to_array<Field>({kPosX, kPosY, kPosZ, kNormalX, kNormalY, kNormalZ, kDepth, kFlow});
inline constexpr auto kHitFields =
    std::to_array<Field>({kPosX, kPosY, kPosZ, kNormalX, kNormalY, kNormalZ, kDepth, kHit});
}  // namespace contact

namespace contact_line {
inline constexpr auto kFields =
    std::to_array<Field>({{"FIRST", 0, 32, "", "CONTACT"}, {"SECOND", 32, 32, "", "CONTACT"}});
}  // namespace contact_line

namespace checked_line {  ///< what the lines with a check word have in common
inline constexpr auto kFields =
    std::to_array<Field>({{"BODY", 0, kCheckOffset, "words 0 to 6"}, {"CHECK", 56, 8, ""}});
}  // namespace checked_line

struct Record {
  std::string_view name;
  std::string_view place;
  std::span<const Field> fields;
  std::uint32_t bytes = kLineBytes;
};

/// A record stands behind those that it holds.
inline constexpr auto kRecords = std::to_array<Record>({
    {"SPL2_CNTXT", "64 bytes at SPL2_CNTXT_BASE", spl2_cntxt::kFields},
    {"PTE", "one line per page-table entry", pte::kFields},
    {"VAFU2_CNTXT", "line at AFU_CNTXT_BASE", vafu2_cntxt::kFields},
    {"STATUS", "line at AFU_CNTXT_BASE + 64", status::kFields},
    {"CONTROL", "line at AFU_CNTXT_BASE + 128: the control memory", control::kFields},
    {"SPL_FAULT", "line 1 of the SPL2 DSM", spl_fault::kFields},
    {"DSM_ID", "line 0 of the AFU DSM", dsm_id::kFields},
    {"DSM_LATENCY", "line 4 of the AFU DSM", dsm_latency::kFields},
    {"DSM_PERFORMANCE", "line 5 of the AFU DSM", dsm_performance::kFields},
    {"CHECKED_LINE", "any line with a check word", checked_line::kFields},
    {"SPHERE", "16 bytes of the sphere array, four a line", sphere::kFields, kSphereBytes},
    {"PAIR", "32 bytes of Src in the direct formats", pair::kFields, kPairBytes},
    {"PAIR_LINE", "a line of Src in the direct formats", pair_line::kFields},
    {"INDEX_PAIR", "4 bytes of Src in the indexed format, 16 a line", index_pair::kFields,
     kIndexPairBytes},
    {"CONTACT", "32 bytes of Dst in the direct format", contact::kFields, kContactBytes},
    {"HIT", "32 bytes of Dst in the hits-only formats", contact::kHitFields, kContactBytes},
    {"CONTACT_LINE", "a line of Dst", contact_line::kFields},
});

// ---- Integrity ---------------------------------------------------------------------------------

// line_fold(w0..w7) is the xor over i of w_i ^ rotl(w_i, kFoldB[i]) ^ rotl(w_i, kFoldC[i]): every
// input bit flips three output bits, no two bits the same three, so that one, two or three wrong
// bits always show. A digest over lines is d = rotl(d, 1) + line_fold(line), from 0.
inline constexpr std::array<std::uint32_t, kWordsPerLine> kFoldB = {1, 2, 3, 4, 5, 6, 7, 8};
inline constexpr std::array<std::uint32_t, kWordsPerLine> kFoldC = {20, 22, 24, 26, 28, 30, 32, 34};

}  // namespace harpoon::afu::contract
