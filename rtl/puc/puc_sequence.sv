// The sequence of a transaction, and in which order the PUC writes lines of its own.
//
// Life: wait until SPL2 is on; fetch the job until its start byte is 0xFF; write the AFU ID into
// the DSM; run; then, each step only after all writes before it were acknowledged: counters into
// the DSM, Status into VAFU2_CNTXT. What the job got wrong ends the same way, with an error code
// and no run. After the end nothing happens until reset.
//
//   Idle -> Fetch <-> Judge -> Fold -> Send (ID) -> Run -> Flush -> Settle
//     -> Fold -> Send (counters, two lines) -> Settle -> Fold -> Send (Status) -> Settle -> Done
//
// In Fold the check word of line `line_o` is worked out, in Send it waits for `write_ready_i`.
// `start_o` (one cycle) begins a run. The AFU ID is written as well whenever `dsm_commit_i` said
// where, before the first transaction.
module puc_sequence (
  input  logic                         clk_i,
  input  logic                         rst_ni,        // ends a transaction
  input  logic                         cold_rst_ni,   // also forgets a committed DSM

  input  logic                         spl2_on_i,
  input  logic                         dsm_commit_i,
  input  logic                         got_control_i,
  input  logic                         go_i,
  input  harpoon_contract_pkg::error_e verdict_i,
  input  logic                         run_over_i,       // every pair was dispatched
  input  logic                         index_error_i,
  input  logic                         results_idle_i,   // no result waits to be written
  input  logic                         no_results_i,     // none was written
  input  logic                         writes_idle_i,    // every write is acknowledged
  input  logic                         write_ready_i,    // for a line of its own

  output logic                         ask_all_o,
  output logic                         ask_again_o,
  output logic                         start_o,
  output logic                         running_o,
  output puc_pkg::state_e              state_o,
  output puc_pkg::line_e               line_o,
  output harpoon_contract_pkg::error_e error_o
);
  puc_pkg::state_e state_q;
  puc_pkg::line_e  line_q;
  logic            start_q, running_q, id_pending_q, no_results;
  harpoon_contract_pkg::error_e error_q;

  assign ask_all_o   = (state_q == puc_pkg::Idle) & ~id_pending_q & spl2_on_i;
  assign ask_again_o = (state_q == puc_pkg::Judge) & ~go_i;
  assign start_o     = start_q;
  assign running_o   = running_q;
  assign state_o     = state_q;
  assign line_o      = line_q;
  assign error_o     = error_q;

  // Without results there is nothing to be acknowledged before the counters.
  assign no_results  = (line_q == puc_pkg::SendLatency) & no_results_i;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q   <= puc_pkg::Idle;
      line_q    <= puc_pkg::SendNothing;
      start_q   <= 1'b0;
      running_q <= 1'b0;
      error_q   <= harpoon_contract_pkg::ERROR_NONE;
    end else begin
      start_q <= 1'b0;
      unique case (state_q)
        puc_pkg::Idle: begin
          if (id_pending_q) begin
            line_q  <= puc_pkg::SendId;
            state_q <= puc_pkg::Fold;
          end else if (spl2_on_i) begin
            state_q <= puc_pkg::Fetch;
          end
        end
        puc_pkg::Fetch: if (got_control_i) state_q <= puc_pkg::Judge;
        puc_pkg::Judge: begin
          if (!go_i) begin
            state_q <= puc_pkg::Fetch;
          end else begin
            error_q <= verdict_i;
            state_q <= puc_pkg::Fold;
            if (verdict_i == harpoon_contract_pkg::ERROR_NONE) begin
              start_q   <= 1'b1;
              running_q <= 1'b1;
              line_q    <= puc_pkg::SendId;
            end else begin
              line_q <= puc_pkg::SendLatency;
            end
          end
        end
        puc_pkg::Fold: state_q <= puc_pkg::Send;
        puc_pkg::Send: if (write_ready_i) begin
          unique case (line_q)
            puc_pkg::SendId: state_q <= running_q ? puc_pkg::Run : puc_pkg::Idle;
            puc_pkg::SendLatency: begin
              line_q  <= puc_pkg::SendPerformance;
              state_q <= puc_pkg::Fold;
            end
            puc_pkg::SendPerformance: begin
              line_q  <= puc_pkg::SendStatus;
              state_q <= puc_pkg::Settle;
            end
            default: begin
              line_q  <= puc_pkg::SendNothing;
              state_q <= puc_pkg::Settle;
            end
          endcase
        end
        puc_pkg::Run: if (run_over_i) state_q <= puc_pkg::Flush;
        puc_pkg::Flush: begin
          line_q  <= puc_pkg::SendLatency;
          state_q <= puc_pkg::Settle;
        end
        puc_pkg::Settle: if (results_idle_i & (writes_idle_i | no_results)) begin
          if (line_q == puc_pkg::SendLatency) begin
            running_q <= 1'b0;
            if (index_error_i) error_q <= harpoon_contract_pkg::ERROR_INDEX;
          end
          state_q <= (line_q == puc_pkg::SendNothing) ? puc_pkg::Done : puc_pkg::Fold;
        end
        default: ;
      endcase
    end
  end

  always_ff @(posedge clk_i) begin
    if (!cold_rst_ni) id_pending_q <= 1'b0;
    else if (dsm_commit_i) id_pending_q <= 1'b1;
    else if ((state_q == puc_pkg::Send) & (line_q == puc_pkg::SendId) & ~running_q)
      id_pending_q <= 1'b0;
  end
endmodule
