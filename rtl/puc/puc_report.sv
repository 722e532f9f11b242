// The lines that the PUC itself writes: AFU ID and counters into the DSM, Status into VAFU2_CNTXT.
//
// No state. `line_o` without its check word is to be folded in one cycle; in the next, with
// `fold_i` that fold, `data_o` is the whole line and `write_line_o` its address, in the DSM if
// `dsm_o`. What goes into a line must hold still over both: the counters stop before they are sent.
module puc_report #(
  parameter int unsigned Spheres = 16384
) (
  input  puc_pkg::line_e                which_i,
  input  logic [57:0]                   context_line_i,
  input  harpoon_contract_pkg::config_t config_i,
  input  logic [31:0]                   sequence_i,
  input  logic [31:0]                   loaded_i,     // spheres in the table
  input  harpoon_contract_pkg::error_e  error_i,
  input  puc_pkg::counters_t            counters_i,
  input  puc_pkg::digests_t             digests_i,
  input  puc_pkg::results_t             results_i,
  input  logic [63:0]                   fold_i,
  output logic [511:0]                  line_o,
  output logic [511:0]                  data_o,
  output logic                          dsm_o,
  output logic [57:0]                   write_line_o
);
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("puc_report: Spheres must be a power of two, 8 to 65536");

  harpoon_contract_pkg::dsm_id_t          id_line;
  harpoon_contract_pkg::dsm_latency_t     latency_line;
  harpoon_contract_pkg::dsm_performance_t performance_line;
  harpoon_contract_pkg::status_t          status_line;
  harpoon_contract_pkg::checked_line_t    line;

  always_comb begin
    id_line          = '0;
    latency_line     = '0;
    performance_line = '0;
    status_line      = '0;
    unique case (which_i)
      puc_pkg::SendId: begin
        id_line.low           = harpoon_contract_pkg::AFU_ID_LOW;
        id_line.high          = harpoon_contract_pkg::AFU_ID_HIGH;
        id_line.config_word   = config_i;
        id_line.table_spheres = Spheres;
        id_line.sequence_word = sequence_i;
        line                  = id_line;
        write_line_o          = {52'd0, harpoon_contract_pkg::DSM_ID_LINE};
      end
      puc_pkg::SendLatency: begin
        latency_line.sequence_word = sequence_i;
        latency_line.first_line    = counters_i.first_line;
        latency_line.first_write   = counters_i.first_write;
        latency_line.last_write    = counters_i.last_write;
        latency_line.read_stalls   = counters_i.read_stalls;
        latency_line.write_stalls  = counters_i.write_stalls;
        latency_line.spl2_cycles   = counters_i.spl2_cycles;
        latency_line.sphere_count  = loaded_i;
        line                       = latency_line;
        write_line_o               = {52'd0, harpoon_contract_pkg::DSM_LATENCY_LINE};
      end
      puc_pkg::SendPerformance: begin
        performance_line.cycles        = counters_i.cycles;
        performance_line.sequence_word = sequence_i;
        performance_line.lines_read    = counters_i.lines_read;
        performance_line.lines_written = results_i.lines;
        performance_line.hits          = results_i.hits;
        performance_line.scpu_pairs    = results_i.pairs;
        performance_line.source_digest = digests_i.source;
        performance_line.dest_digest   = digests_i.dest;
        line                           = performance_line;
        write_line_o                   = {52'd0, harpoon_contract_pkg::DSM_PERFORMANCE_LINE};
      end
      default: begin
        status_line.status.done   = 1'b1;
        status_line.status.failed = error_i != harpoon_contract_pkg::ERROR_NONE;
        status_line.error.code    = error_i;
        status_line.sequence_word = sequence_i;
        status_line.hits          = results_i.hits;
        line                      = status_line;
        write_line_o              = context_line_i + harpoon_contract_pkg::STATUS_LINE;
      end
    endcase
  end
  assign line_o = line;
  assign data_o = {harpoon_contract_pkg::CHECK_SEED ^ fold_i, line.body};
  assign dsm_o  = which_i != puc_pkg::SendStatus;
endmodule
