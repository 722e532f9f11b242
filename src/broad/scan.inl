// A block against the bodies that are in no grid: few, and huge or far beside the others.

/// A block against all scanned bodies: each of them in turn against those leaves that it reaches.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult scan(const SearchJob<Cull>& job, std::uint32_t begin, std::uint32_t end,
                               Candidates& list, RoomMaker& room) {
  HWY_ALIGN Cull memory[6][kTreeWidth];
  const NodeBoxes<Cull> boxes = {memory[0], memory[1], memory[2], memory[3], memory[4], memory[5]};
  const std::uint32_t count = fill_leaves<Shape>(job.bodies, begin, end, boxes, 0);
  clear_boxes(boxes, count, kTreeWidth);
  const Cull largest = *std::max_element(job.bodies.r + begin, job.bodies.r + end);
  const BlockLeaves<Cull> leaves = {boxes, 0, begin, end, around(boxes, 0, count), largest};
  const BlockSearch<Shape> block{job, begin, list, room};
  Cursor<Shape> cursor(list);
  SearchResult found;
  for (std::uint32_t i = job.scanned_begin; i < job.scanned_end; i += kTreeWidth) {
    const std::uint32_t last = std::min(job.scanned_end, i + kTreeWidth);
    cursor = test_against(block, leaves, i, last, cursor, found);
  }
  list.count = cursor.count;
  return found;
}

/// Scanned bodies [begin, end) among themselves and the later ones. Boxes may lie beyond all
/// culling coordinates, where those are equal.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult scan_scanned(const SearchJob<Cull>& job, std::uint32_t begin,
                                       std::uint32_t end, Candidates& list, RoomMaker& room) {
  SearchJob<Cull> doubtful = job;
  doubtful.judge_touching = true;
  const BlockSearch<Shape> block{doubtful, begin, list, room};
  Cursor<Shape> cursor(list);
  std::uint64_t tested = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    tested += job.scanned_end - i - 1;
    cursor = test_run(block, i, i + 1, job.scanned_end, cursor);
  }
  list.count = cursor.count;
  return {0, true, tested};
}
