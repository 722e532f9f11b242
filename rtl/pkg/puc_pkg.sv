// What the parts of the PUC hand to each other: the stream of pairs that every front end makes, the
// numbered lines that it is made of, the job, the counters, and the states of the sequence.
//
// The stream is ready/valid, a beat one or two pairs with their tags, in pair order. The last beat
// of a job, and no other, says `last`; it may hold no pair (`mask` 00), every other beat holds one
// or two (01 or 11). So a front end may say `last` with its last pair, or once it knows that there
// will be none. Pairs, contacts and lines travel beside these structs, as records of the contract.
package puc_pkg;
  typedef struct packed {
    logic [30:0] second;   // numbers of the pairs
    logic [30:0] first;
  } tags_t;

  typedef struct packed {
    logic       last;
    logic [1:0] mask;
    tags_t      tags;
  } beat_t;

  typedef struct packed {
    logic [1:0] mask;
    tags_t      tags;
  } result_t;

  // A line of Src: how many pairs it holds, the number of the first, and whether it is the last.
  typedef struct packed {
    logic        last;
    logic [4:0]  count;
    logic [30:0] number;
  } source_t;

  // What the context and the control line ask for.
  typedef struct packed {
    logic        load_table;
    logic [57:0] source_line;
    logic [57:0] dest_line;
    logic [57:0] spheres_line;
    logic [31:0] dest_lines;
    logic [31:0] pair_count;
    logic [31:0] sphere_count;
    logic [31:0] sequence_word;
  } job_t;

  // What follows from it.
  typedef struct packed {
    logic        indexed;
    logic        hits_only;
    logic [31:0] source_lines;    // that hold the pairs
    logic [31:0] table_lines;     // that hold the spheres to load
  } plan_t;

  typedef struct packed {
    logic [31:0] cycles;
    logic [31:0] spl2_cycles;
    logic [31:0] first_line;
    logic [31:0] first_write;
    logic [31:0] last_write;
    logic [31:0] read_stalls;
    logic [31:0] write_stalls;
    logic [31:0] lines_read;
  } counters_t;

  // Of all lines that came, and of all that went.
  typedef struct packed {
    logic [63:0] source;
    logic [63:0] dest;
  } digests_t;

  // What the dispatcher counts.
  typedef struct packed {
    logic [31:0] lines;
    logic [31:0] hits;
    logic [31:0] pairs;
  } results_t;

  typedef enum logic [3:0] {
    Idle, Fetch, Judge, Fold, Send, Run, Flush, Settle, Done
  } state_e;

  // The line that the PUC itself writes next.
  typedef enum logic [2:0] {SendId, SendLatency, SendPerformance, SendStatus, SendNothing} line_e;
endpackage
