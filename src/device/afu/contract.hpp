#pragma once

// The contract between the AFU's host half and its RTL: register offsets, record layouts, formats,
// limits and error codes. The only place where they are written down: the SystemVerilog package
// harpoon_contract_pkg and the register map in the docs are generated from it by harpoon-contract
// (src/hls/contract.cpp). Constants only: no behaviour, no I/O.

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
/// An index pair is two 16-bit indices, the first in the low half.
inline constexpr std::uint32_t kIndexPairsPerLine = kLineBytes / 4;

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
/// Word 7 of a result: `direct` has the flow (1, 2 or 3); the hits-only formats have the pair
/// number in bits 30:0 and a grazing mark in bit 31.
inline constexpr std::uint32_t kGrazingBit = 31;
inline constexpr std::uint32_t kFlowFake = 1;
inline constexpr std::uint32_t kFlowGrazing = 2;
inline constexpr std::uint32_t kFlowReal = 3;

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

inline constexpr std::uint32_t kApStart = 1u << 0;
inline constexpr std::uint32_t kApDone = 1u << 1;
inline constexpr std::uint32_t kApIdle = 1u << 2;
inline constexpr std::uint32_t kApReady = 1u << 3;
inline constexpr std::uint32_t kChReset = 1u << 0;
inline constexpr std::uint32_t kChEnable = 1u << 1;
inline constexpr std::uint32_t kModeBatchBarrier = 1u << 0;

struct Register {
  std::uint32_t offset;
  std::uint32_t bytes;
  std::string_view name;
  std::string_view access;
  std::string_view meaning;
};

inline constexpr auto kRegisters = std::to_array<Register>({
    {kRegApCtrl, 4, "AP_CTRL", "RW",
     "bit 0 ap_start (same as CH_CTRL enable), 1 ap_done (clear on read), 2 ap_idle, 3 ap_ready"},
    {kRegAfuId0, 4, "AFU_ID_0", "RO", "AFU ID, bits 31:0"},
    {kRegAfuId1, 4, "AFU_ID_1", "RO", "AFU ID, bits 63:32"},
    {kRegAfuId2, 4, "AFU_ID_2", "RO", "AFU ID, bits 95:64"},
    {kRegAfuId3, 4, "AFU_ID_3", "RO", "AFU ID, bits 127:96"},
    {kRegConfig, 4, "CONFIG", "RO", "bits 7:0 SCPUs, 15:8 most lines in flight, 23:16 index lanes"},
    {kRegTableSpheres, 4, "TABLE_SPHERES", "RO", "spheres that the on-chip table holds"},
    {kRegInFlight, 4, "IN_FLIGHT", "RW",
     "most lines in flight each way; kept over CH_CTRL reset; capped by CONFIG"},
    {kRegPucMode, 4, "PUC_MODE", "RW",
     "bit 0 batch barrier: N pairs at a time, as published; kept over CH_CTRL reset"},
    {kRegSpl2Fault, 4, "SPL2_FAULT", "RO",
     "bit 0 valid, 7:4 fault, 11:8 request (1 read, 2 write)"},
    {kRegFaultAddressLow, 4, "FAULT_ADDRESS_LO", "RO", "address of the fault, bits 31:0"},
    {kRegFaultAddressHigh, 4, "FAULT_ADDRESS_HI", "RO", "address of the fault, bits 63:32"},
    {kRegAfuError, 4, "AFU_ERROR", "RO", "error code of the last transaction, as in Status"},
    {kRegState, 4, "STATE", "RO",
     "bits 3:0 PUC state, 7:4 SPL2 state, 15:8 reads and 23:16 writes outstanding"},
    {kRegSplDsmBase, 8, "SPL_DSM_BASE", "WO", "physical address; the commit writes SPL_ID there"},
    {kRegSpl2CntxtBase, 8, "SPL2_CNTXT_BASE", "WO", "physical address of SPL2_CNTXT"},
    {kRegSpl2ChCtrl, 4, "SPL2_CH_CTRL", "WO",
     "bit 0 reset (drains the bus, ends by itself), bit 1 enable (start the transaction)"},
    {kRegAfuDsmBase, 8, "AFU_DSM_BASE", "WO", "physical address; the commit writes AFU_ID there"},
    {kRegAfuCntxtBase, 8, "AFU_CNTXT_BASE", "WO", "workspace address of VAFU2_CNTXT"},
});

// ---- Records in memory -------------------------------------------------------------------------

/// A little-endian number inside a record.
struct Field {
  std::string_view name;
  std::uint32_t offset;  ///< bytes
  std::uint32_t bytes;
  std::string_view meaning;
};

/// Lines that steer the device carry a check word: kCheckSeed ^ line_fold(words 0 to 6). A line
/// that arrives with up to three wrong bits never matches it.
inline constexpr std::uint64_t kCheckSeed = 0x5ca1'ab1e'0ddb'a115;
inline constexpr std::uint32_t kCheckOffset = 56;

namespace spl2_cntxt {  ///< 64 bytes at SPL2_CNTXT_BASE
inline constexpr Field kPageTable{"PAGE_TABLE", 0, 8, "physical address of the page table"};
inline constexpr Field kAfuContext{"AFU_CONTEXT", 8, 8, "workspace base (virtual, 2 MB aligned)"};
inline constexpr Field kPageSize{"PAGE_SIZE", 16, 4, "bit 0: 1 = 2 MB, the only one"};
inline constexpr Field kPageCount{"PAGE_COUNT", 20, 4, "number of entries, 1 to 1024"};
inline constexpr Field kControl{"CONTROL", 24, 4, "bit 0: virtual mode, must be 1"};
inline constexpr Field kHandle{"HANDLE", 32, 8, "for software"};
inline constexpr Field kAfuDsm{"AFU_DSM", 40, 8, "physical address of the AFU DSM"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>(
    {kPageTable, kAfuContext, kPageSize, kPageCount, kControl, kHandle, kAfuDsm, kCheck});
}  // namespace spl2_cntxt

namespace pte {  ///< one line per entry
inline constexpr Field kEntry{"ENTRY", 0, 8, "bit 0 valid, 63:21 physical page"};
inline constexpr Field kIndex{"INDEX", 8, 4, "its own place in the table"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>({kEntry, kIndex, kCheck});
}  // namespace pte

namespace vafu2_cntxt {  ///< 128 bytes at AFU_CNTXT_BASE, then the control line
inline constexpr Field kSource{"SOURCE", 8, 8, "Src: pairs or index pairs"};
inline constexpr Field kDest{"DEST", 16, 8, "Dst: results"};
inline constexpr Field kSourceLines{"SOURCE_LINES", 24, 4, "num_cl: lines in Src"};
inline constexpr Field kDestLines{"DEST_LINES", 28, 4, "lines in Dst; nothing is written beyond"};
inline constexpr Field kSpheres{"SPHERES", 32, 8, "sphere array (indexed format)"};
inline constexpr Field kSphereCount{"SPHERE_COUNT", 40, 4, "spheres to load (indexed format)"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>(
    {kSource, kDest, kSourceLines, kDestLines, kSpheres, kSphereCount, kCheck});
inline constexpr std::uint32_t kStatusOffset = 64;    ///< the Status line
inline constexpr std::uint32_t kControlOffset = 128;  ///< the control memory
inline constexpr std::uint32_t kBytes = 192;
}  // namespace vafu2_cntxt

namespace status {  ///< the line at VAFU2_CNTXT + 64
inline constexpr Field kStatus{"STATUS", 0, 4, "bit 0 DONE, bit 1 ERROR"};
inline constexpr Field kError{"ERROR", 4, 4, "AfuError"};
inline constexpr Field kSequence{"SEQUENCE", 8, 4, "copied from the control line"};
inline constexpr Field kHits{"HITS", 12, 4,
                             "hits found (hits-only formats: also those not written)"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields = std::to_array<Field>({kStatus, kError, kSequence, kHits, kCheck});
inline constexpr std::uint32_t kDone = 1u << 0;
inline constexpr std::uint32_t kFailed = 1u << 1;
}  // namespace status

namespace control {  ///< control memory, the line at VAFU2_CNTXT + 128
inline constexpr Field kStart{"START", 0, 1, "0xFF = start; written last"};
inline constexpr Field kReset{"RESET", 1, 1, "0xFF, without START = forget the sphere table"};
inline constexpr Field kPairCount{"PAIR_COUNT", 4, 4, "n_col"};
inline constexpr Field kFormat{"FORMAT", 8, 4, "Format"};
inline constexpr Field kSequence{"SEQUENCE", 12, 4, "number of the transaction"};
inline constexpr Field kLoadTable{"LOAD_TABLE", 16, 4, "bit 0: load the sphere table first"};
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
inline constexpr Field kStatus{"STATUS", 4, 4, "Spl2Fault"};
inline constexpr Field kRequest{"REQUEST", 8, 4, "1 read, 2 write"};
inline constexpr Field kAddress{"ADDRESS", 16, 8, "address of the request"};
inline constexpr Field kCheck{"CHECK", 56, 8, "check word"};
inline constexpr auto kFields =
    std::to_array<Field>({kValid, kError, kStatus, kRequest, kAddress, kCheck});
}  // namespace spl_fault

namespace dsm_id {  ///< AFU DSM line 0
inline constexpr Field kLow{"LOW", 0, 8, "AFU ID, low word"};
inline constexpr Field kHigh{"HIGH", 8, 8, "AFU ID, high word"};
inline constexpr Field kConfig{"CONFIG", 16, 4, "as the register CONFIG"};
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

struct Record {
  std::string_view name;
  std::string_view place;
  std::span<const Field> fields;
};

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
});

// ---- Integrity ---------------------------------------------------------------------------------

// line_fold(w0..w7) is the xor over i of w_i ^ rotl(w_i, kFoldB[i]) ^ rotl(w_i, kFoldC[i]): every
// input bit flips three output bits, no two bits the same three, so that one, two or three wrong
// bits always show. A digest over lines is d = rotl(d, 1) + line_fold(line), from 0.
inline constexpr std::array<std::uint32_t, kWordsPerLine> kFoldB = {1, 2, 3, 4, 5, 6, 7, 8};
inline constexpr std::array<std::uint32_t, kWordsPerLine> kFoldC = {20, 22, 24, 26, 28, 30, 32, 34};

}  // namespace harpoon::afu::contract
