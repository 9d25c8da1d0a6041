// SPDX-License-Identifier: Apache-2.0
// Source for a device: an AXI4 read master that reads a stream from memory, command by command. It requests the splats
// of a cull group only if the device can see it (docs/microarchitecture.md, "Fetch"; cmodel/io/fetch_commands.hpp makes
// the commands).
// Requests: command -> run of beats -> burst -> address channel. Beats: data channel -> queue -> stream. Verdicts: a
// group that was sent -> run of beats, or the address advances without it.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_fetch #(
    parameter int ADDRESS_BITS = 64,  // bits of a memory address
    parameter int BURST = 16,         // most beats of a burst
    parameter int DEPTH_LOG2 = 6,     // log2 of the beats that may be requested and not sent yet
    parameter int OUTSTANDING = 64,   // most bursts in flight
    parameter int SETS_LOG2 = 10,     // log2 of the most groups of a command
    parameter int JUDGED_LOG2 = 4     // log2 of the most groups sent without a verdict yet
) (
    input  logic         aclk,
    input  logic         aresetn,  // synchronous
    // commands: splats, sets, beats, 32 bits each, and in the lowest bits an address of 64
    input  logic         s_axis_cmd_tvalid,
    output logic         s_axis_cmd_tready,
    input  logic [159:0] s_axis_cmd_tdata,
    // memory
    output logic         m_axi_arvalid,
    input  logic         m_axi_arready,
    output logic [ADDRESS_BITS-1:0] m_axi_araddr,
    output logic [7:0]   m_axi_arlen,
    output logic [2:0]   m_axi_arsize,
    output logic [1:0]   m_axi_arburst,
    output logic [3:0]   m_axi_arcache,
    output logic [2:0]   m_axi_arprot,
    input  logic         m_axi_rvalid,
    output logic         m_axi_rready,
    input  logic [255:0] m_axi_rdata,
    input  logic [1:0]   m_axi_rresp,
    input  logic         m_axi_rlast,
    // to the device, and its verdicts
    output logic         m_axis_tvalid,
    input  logic         m_axis_tready,
    output logic [255:0] m_axis_tdata,
    input  logic         verdict_valid,
    input  logic [31:0]  verdict_tag,
    input  logic         verdict_hidden,
    // While high nothing is requested, commands are taken and dropped, verdicts are ignored. Once busy is 0 the state
    // is that after a reset. The host keeps it high until the device has no more verdicts to give.
    input  logic         stop,
    output logic         busy,   // a command is at work, or a requested beat was not sent
    output logic [1:0]   error   // the first error; stays until stop or reset; nothing is requested meanwhile
);
  localparam int AB = ADDRESS_BITS;
  localparam int BEAT_LOG2 = 5, PAGE_LOG2 = 12;  // bytes of a beat; no burst crosses a page
  localparam int PB = PAGE_LOG2 - BEAT_LOG2 + 1;
  localparam int DB = DEPTH_LOG2 + 1;
  localparam int OB = $clog2(OUTSTANDING + 1);
  localparam int SB = SETS_LOG2 + 1;
  localparam int RUNS_LOG2 = SETS_LOG2, BURSTS_LOG2 = $clog2(OUTSTANDING);
  localparam logic [1:0] NONE = 2'd0, RESPONSE = 2'd1, VERDICT = 2'd2, COMMAND = 2'd3;
  `FASTSPLAT_INIT(burst, BURST >= 1 && BURST <= 128 && BURST <= (1 << DEPTH_LOG2), "BURST = %0d, not 1 to 128, or more than there is room for (%0d)", BURST, 1 << DEPTH_LOG2)
  `FASTSPLAT_INIT(outstanding, OUTSTANDING >= 2 && OUTSTANDING <= 1024, "OUTSTANDING = %0d, not 2 to %0d", OUTSTANDING, 1024)
  `FASTSPLAT_INIT(depth, DEPTH_LOG2 >= 1 && DEPTH_LOG2 <= 16, "DEPTH_LOG2 = %0d, not 1 to %0d", DEPTH_LOG2, 16)
  `FASTSPLAT_INIT(sets, SETS_LOG2 >= 1 && SETS_LOG2 <= 16, "SETS_LOG2 = %0d, not 1 to %0d", SETS_LOG2, 16)
  `FASTSPLAT_INIT(judged, JUDGED_LOG2 >= 3 && JUDGED_LOG2 <= 10, "JUDGED_LOG2 = %0d, not 3 to %0d", JUDGED_LOG2, 10)
  `FASTSPLAT_INIT(address, ADDRESS_BITS >= 16 && ADDRESS_BITS <= 64, "ADDRESS_BITS = %0d, not 16 to %0d", ADDRESS_BITS, 64)

  logic clk_i, rst_ni;
  assign clk_i = aclk;
  assign rst_ni = aresetn;

  // Used in several parts below.
  logic failed, forget;  // forget: resets all but the ports to memory and device
  logic [31:0] run_beats, run_skip;
  logic [DB-1:0] unsent_q;  // beats that arrived and were not sent
  assign failed = error != NONE;

  logic unused;  // high bits of counts, where addresses are short
  assign unused = &{1'b0, run_skip, run_beats};

  // ---- verdicts: cull groups that were sent, oldest first, and what follows from their verdicts
  logic sent_set, sent_counted, judged_valid, judged_counted;
  logic [31:0] judged_tag, judged_splats;
  // A cull_block waits while the queue for verdicts is full, except during stop (M-fetch-16, M-fetch-22).
  logic [JUDGED_LOG2:0] unjudged_q;
  logic judged_full;
  assign judged_full = unjudged_q[JUDGED_LOG2];
  always_ff @(posedge clk_i) begin
    unjudged_q <= unjudged_q + (JUDGED_LOG2 + 1)'(sent_set && !judged_full) - (JUDGED_LOG2 + 1)'(verdict_valid && judged_valid);
    if (!rst_ni || forget) unjudged_q <= '0;
  end
  fastsplat_queue #(
      .BITS(65),
      .LOG2(JUDGED_LOG2)
  ) u_judged (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .clear_i(forget),
      .put_i(sent_set && !judged_full),
      .data_i({sent_counted, m_axis_tdata[32*5+:32], m_axis_tdata[32+:32]}),
      .valid_o(judged_valid),
      .take_i(verdict_valid),
      .data_o({judged_counted, judged_splats, judged_tag})
  );
  // Groups of the command without a verdict; splats left out behind the last run.
  logic [SB-1:0] undecided_q;
  logic [31:0] skipped_q;
  logic judges, last_set, wrong_verdict;
  // hides_q: a group of the command was hidden. trusts_q: none of the one before was (M-fetch-4).
  logic hides_q, trusts_q;
  assign wrong_verdict = verdict_valid && !stop && (!judged_valid || (judged_tag != verdict_tag && !`FASTSPLAT_FAULT(FETCH_ANY_TAG)));
  assign judges = verdict_valid && judged_valid && judged_counted;
  assign last_set = undecided_q == SB'(1);

  logic run_put, run_valid, run_take, run_last;
  logic [31:0] seen_splats;
  assign seen_splats = trusts_q || (verdict_hidden && !`FASTSPLAT_FAULT(FETCH_HIDDEN_TOO)) ? 32'd0 : judged_splats;
  assign run_put = judges && (last_set || seen_splats != 32'd0);
  fastsplat_queue #(
      .BITS(65),
      .LOG2(RUNS_LOG2)
  ) u_runs (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .clear_i(forget),
      .put_i(run_put),
      .data_i({last_set, seen_splats, skipped_q}),
      .valid_o(run_valid),
      .take_i(run_take),
      .data_o({run_last, run_beats, run_skip})
  );

  // ---- commands and runs: what is requested next
  typedef enum logic [1:0] {PhNone, PhPlain, PhSets, PhRuns} phase_e;
  phase_e phase_q;  // what the current run reads: nothing, beats of the command, its cull_blocks, their splats
  logic [AB-1:0] command_address, address_q, body_q, run_address;
  logic [31:0] command_beats, command_sets, command_splats, left_q, burst_left;
  logic [SB-1:0] sets_q;
  logic [31:0] splats_q;
  logic counted_q, run_valid_q, last_run_q;
  assign {command_splats, command_sets, command_beats} = s_axis_cmd_tdata[159:64];
  assign command_address = s_axis_cmd_tdata[AB-1:0];

  logic legal;
  if (AB < 64) begin : gen_narrow
    assign legal = s_axis_cmd_tdata[BEAT_LOG2-1:0] == '0 && s_axis_cmd_tdata[63:AB] == '0 && command_beats != '0 && command_sets <= command_beats &&
                   command_sets <= 32'd1 << SETS_LOG2 && (command_splats == '0 || command_sets != '0);
  end else begin : gen_wide
    assign legal = s_axis_cmd_tdata[BEAT_LOG2-1:0] == '0 && command_beats != '0 && command_sets <= command_beats &&
                   command_sets <= 32'd1 << SETS_LOG2 && (command_splats == '0 || command_sets != '0);
  end

  logic issue, ends_run, wants_sets, wants_all, wants_run, wants_command, takes_command;
  assign ends_run = issue && burst_left == '0;
  assign wants_sets = phase_q == PhPlain && sets_q != '0;
  assign wants_all = phase_q == PhSets && counted_q && trusts_q;
  assign wants_run = (phase_q == PhSets && counted_q && !trusts_q) || (phase_q == PhRuns && !last_run_q);
  // After an error or a stop nothing is requested: runs that are taken then are forgotten.
  assign run_take = (!run_valid_q || ends_run) && wants_run && run_valid;
  // The last group's run may be empty; the next command's then follows at once.
  assign wants_command = (!run_valid_q || ends_run) && !failed && (!(wants_sets || wants_all || wants_run) || (run_take && run_beats == '0));
  assign s_axis_cmd_tready = wants_command || stop;
  assign takes_command = s_axis_cmd_tvalid && wants_command && !stop;
  assign run_address = body_q + (AB'(run_skip) << BEAT_LOG2);

  // ---- bursts
  logic [PB-1:0] to_page, burst;
  logic [31:0] most;
  logic [DB-1:0] room_q;
  logic [OB-1:0] outstanding_q;
  logic ends_burst;
  assign to_page = PB'(1 << (PB - 1)) - PB'(address_q[PAGE_LOG2-1:BEAT_LOG2]);
  assign most = (32'(to_page) < 32'(BURST) && !`FASTSPLAT_FAULT(FETCH_OVER_PAGE)) ? 32'(to_page) : 32'(BURST);
  assign burst = (left_q < most) ? PB'(left_q) : PB'(most);
  assign burst_left = left_q - 32'(burst);
  assign issue = run_valid_q && (!m_axi_arvalid || m_axi_arready) && (room_q >= DB'(BURST) || `FASTSPLAT_FAULT(FETCH_NO_ROOM)) && outstanding_q < OB'(OUTSTANDING) && !failed && !stop;
  assign m_axi_arsize = 3'(BEAT_LOG2);
  assign m_axi_arburst = 2'b01;  // INCR
  assign m_axi_arcache = 4'b0011;
  assign m_axi_arprot = 3'b000;

  logic arrived_set, arrived_counted, burst_known, of_sets;
  assign of_sets = phase_q == PhSets;
  fastsplat_queue #(
      .BITS(2),
      .LOG2(BURSTS_LOG2)
  ) u_bursts (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .clear_i(1'b0),
      .put_i(issue),
      .data_i({counted_q, of_sets}),
      .valid_o(burst_known),
      .take_i(ends_burst),
      .data_o({arrived_counted, arrived_set})
  );

  // ---- beats: there is room for all requested ones
  logic arrives, bad, hole_q;  // a beat could not be read: none behind it may be sent
  assign m_axi_rready = 1'b1;
  assign bad = m_axi_rvalid && m_axi_rresp != 2'b00 && !`FASTSPLAT_FAULT(FETCH_BAD_RESPONSE);
  assign arrives = m_axi_rvalid && !bad && !hole_q;
  assign ends_burst = m_axi_rvalid && m_axi_rlast;
  logic sending_set, sending_counted, sends, has_beat, held_q, stop_q;
  fastsplat_queue #(
      .BITS(258),
      .LOG2(DEPTH_LOG2)
  ) u_beats (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .clear_i(1'b0),
      .put_i(arrives),
      .data_i({arrived_counted, arrived_set, m_axi_rdata}),
      .valid_o(has_beat),
      .take_i(sends),
      .data_o({sending_counted, sending_set, m_axis_tdata})
  );
  assign m_axis_tvalid = has_beat && (!sending_set || !judged_full || stop_q || held_q);
  assign sends = m_axis_tvalid && m_axis_tready;
  assign sent_set = sends && sending_set;
  assign sent_counted = sending_counted;

  logic waits;  // a requested beat has not been sent; outstanding_q counts an offered burst, too
  assign waits = outstanding_q != '0 || unsent_q != '0;
  assign forget = stop && !waits;
  assign busy = waits || ((run_valid_q || wants_run) && !failed);

  always_ff @(posedge clk_i) begin
    unsent_q <= unsent_q + DB'(arrives) - DB'(sends);
    held_q <= rst_ni && m_axis_tvalid && !m_axis_tready;
    stop_q <= stop;
    hole_q <= rst_ni && !forget && (hole_q || bad);
    room_q <= room_q - (issue ? DB'(burst) : '0) + DB'(sends);
    outstanding_q <= outstanding_q + OB'(issue) - OB'(ends_burst);
    if (!m_axi_arvalid || m_axi_arready) begin
      m_axi_arvalid <= issue;
      m_axi_araddr <= address_q;
      m_axi_arlen <= 8'(burst) - 8'd1;
    end
    if (`FASTSPLAT_FAULT(FETCH_VALID_DROPPED) && m_axi_arvalid && !m_axi_arready && left_q[0]) m_axi_arvalid <= 1'b0;
    if (issue) begin
      address_q <= address_q + (AB'(burst) << BEAT_LOG2);
      left_q <= burst_left;
    end
    if (ends_run) run_valid_q <= 1'b0;
    if (ends_run && wants_sets) begin
      run_valid_q <= 1'b1;
      phase_q <= PhSets;
      left_q <= 32'(sets_q);
    end
    if (ends_run && wants_all) begin  // they lie behind the cull_blocks
      run_valid_q <= 1'b1;
      phase_q <= PhRuns;
      left_q <= splats_q;
    end
    if (run_take) begin
      run_valid_q <= run_beats != '0;
      phase_q <= PhRuns;
      last_run_q <= run_last;
      address_q <= run_address;
      body_q <= run_address + (AB'(run_beats) << BEAT_LOG2);
      left_q <= run_beats;
    end
    if (takes_command && legal) begin
      run_valid_q <= 1'b1;
      phase_q <= (command_sets == command_beats) ? PhSets : PhPlain;
      last_run_q <= 1'b0;
      address_q <= command_address;
      left_q <= (command_sets == command_beats) ? command_beats : command_beats - command_sets;
      sets_q <= SB'(command_sets);
      splats_q <= command_splats;
      counted_q <= command_splats != '0;
      body_q <= command_address + (AB'(command_beats) << BEAT_LOG2);
    end
    if (judges) begin
      if (verdict_hidden && judged_splats != 32'd0) hides_q <= 1'b1;
      undecided_q <= undecided_q - SB'(1);
      skipped_q <= verdict_hidden ? skipped_q + judged_splats - 32'(`FASTSPLAT_FAULT(FETCH_SHORT_JUMP) && judged_splats != 32'd0) : seen_splats != 32'd0 ? 32'd0 : skipped_q;
    end
    if (takes_command && legal && command_splats != '0) begin
      undecided_q <= SB'(command_sets);
      skipped_q <= '0;
      hides_q <= 1'b0;
      trusts_q <= !hides_q;
    end
    if (!failed) error <= bad ? RESPONSE : wrong_verdict ? VERDICT : (takes_command && !legal) ? COMMAND : NONE;
    if (!rst_ni || forget) begin
      error <= NONE;
      run_valid_q <= 1'b0;
      phase_q <= PhNone;
      hides_q <= 1'b0;
      room_q <= DB'(1 << DEPTH_LOG2);
    end
    if (!rst_ni) begin
      m_axi_arvalid <= 1'b0;
      outstanding_q <= '0;
      unsent_q <= '0;
    end
  end

  // AXI4: an offer stays; bursts keep within a page and their longest length; there is room for what arrives.
  `FASTSPLAT_ASSERT_HELD(asked_until_taken, m_axi_arvalid && !m_axi_arready, m_axi_arvalid, {m_axi_araddr, m_axi_arlen})
  `FASTSPLAT_ASSERT(burst_within_page, !m_axi_arvalid || 32'(m_axi_araddr[PAGE_LOG2-1:BEAT_LOG2]) + 32'(m_axi_arlen) < 32'd1 << (PAGE_LOG2 - BEAT_LOG2))
  `FASTSPLAT_ASSERT(burst_short_enough, !m_axi_arvalid || 32'(m_axi_arlen) < 32'(BURST))
  `FASTSPLAT_ASSERT_HELD(sent_until_taken, m_axis_tvalid && !m_axis_tready, m_axis_tvalid, sending_set)
  `FASTSPLAT_ASSERT(room_for_all, room_q <= DB'(1 << DEPTH_LOG2))
  // The memory answers only what was requested.
  `FASTSPLAT_ASSUME(answers_what_was_asked, !m_axi_rvalid || burst_known)
  `FASTSPLAT_COVER(jumped, judges && verdict_hidden)
endmodule
