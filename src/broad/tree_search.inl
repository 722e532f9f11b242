// Trees: their boxes, and a block of bodies among those of its own tree and against coarser ones.

/// Boxes of all nodes.
template <template <class, std::size_t> class Shape, class Cull>
void fill_tree(const CullArrays<Cull>& bodies, const Tree<Cull>& tree) {
  using Bodies = Shape<Cull, kLongRunLanes<Cull>>;
  fill_leaves<Bodies>(bodies, tree.begin, tree.end, tree.boxes, tree.first[0]);
  for (std::uint32_t level = 1; level <= tree.levels; ++level) {
    const std::uint32_t below = tree.first[level - 1];
    const std::uint32_t nodes = tree.count[level - 1];
    clear_boxes(tree.boxes, below + nodes,
                below + (nodes + kTreeWidth - 1) / kTreeWidth * kTreeWidth);
    if (level == tree.levels) break;
    for (std::uint32_t node = 0; node < tree.count[level]; ++node) {
      const std::uint32_t from = below + node * kTreeWidth;
      const NodeBox<Cull> box = around(tree.boxes, from, from + kTreeWidth);
      const std::size_t to = tree.first[level] + node;
      tree.boxes.low_x[to] = box.low[0];
      tree.boxes.low_y[to] = box.low[1];
      tree.boxes.low_z[to] = box.low[2];
      tree.boxes.high_x[to] = box.high[0];
      tree.boxes.high_y[to] = box.high[1];
      tree.boxes.high_z[to] = box.high[2];
    }
  }
}

/// Calls visit(node) for the nodes of level `target` from `least` on that meet the box, in order,
/// beginning with the kTreeWidth nodes from `first` on of `level`.
template <class Cull, class Visit>
void each_node(const Tree<Cull>& tree, std::uint32_t level, std::uint32_t first,
               std::uint32_t target, std::uint32_t least, const NodeBox<Cull>& box,
               const Visit& visit) {
  const std::uint32_t shift = 4 * (level - target);
  each_bit(meeting(tree.boxes, tree.first[level] + first, box), [&](std::uint32_t k) HWY_ATTR {
    const std::uint32_t node = first + k;
    if (node < least >> shift) return;
    if (level == target) {
      visit(node);
    } else {
      each_node(tree, level - 1, node * kTreeWidth, target, least, box, visit);
    }
  });
}

template <class Cull>
BlockLeaves<Cull> leaves_of(const Tree<Cull>& tree, std::uint32_t group, std::uint32_t begin,
                            std::uint32_t end) {
  return {tree.boxes, tree.first[0] + std::size_t{group} * kTreeWidth, begin,
          end,        box_at(tree.boxes, tree.first[1] + group),       tree.max_radius};
}

/// A block, which is node `own` of the second level, among its own bodies and those of later ones.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult search_own_tree(const SearchJob<Cull>& job, const Tree<Cull>& tree,
                                          std::uint32_t begin, std::uint32_t end, Candidates& list,
                                          RoomMaker& room) {
  const auto own = static_cast<std::uint32_t>((begin - tree.begin) / kBlockBodies);
  const BlockLeaves<Cull> mine = leaves_of(tree, own, begin, end);
  const BlockSearch<Shape> block{job, begin, list, room};
  Cursor<Shape> cursor(list);
  std::uint64_t tested = 0;
  // The bodies of one of the block's leaves against some leaves of a group.
  const auto leaf_against = [&](std::uint32_t mine_leaf, std::uint32_t group,
                                std::uint32_t near) HWY_ATTR {
    const std::size_t at = tree.first[0] + std::size_t{group} * kTreeWidth;
    const std::uint32_t group_begin = tree.begin + group * static_cast<std::uint32_t>(kBlockBodies);
    const std::uint32_t mine_begin = begin + mine_leaf * kTreeWidth;
    const std::uint32_t mine_end = std::min(end, mine_begin + kTreeWidth);
    for (std::uint32_t i = mine_begin; i < mine_end; ++i) {
      const Shape body(job, i);
      each_bit(body.reaches(tree.boxes, at) & near, [&](std::uint32_t leaf) HWY_ATTR {
        const std::uint32_t from = std::max(group_begin + leaf * kTreeWidth, i + 1);
        const std::uint32_t to = std::min(tree.end, group_begin + (leaf + 1) * kTreeWidth);
        if (from >= to) return;
        tested += to - from;
        cursor = test_run(block, i, from, to, cursor);
      });
    }
  };
  each_node(tree, tree.levels - 1, 0, 1, own, mine.box, [&](std::uint32_t group) HWY_ATTR {
    const std::size_t at = tree.first[0] + std::size_t{group} * kTreeWidth;
    const NodeBox<Cull> box = box_at(tree.boxes, tree.first[1] + group);
    each_bit(meeting(tree.boxes, mine.at, box), [&](std::uint32_t leaf) HWY_ATTR {
      std::uint32_t near = meeting(tree.boxes, at, box_at(tree.boxes, mine.at + leaf));
      if (group == own) near &= 0xFFFFFFFFU << leaf;
      if (near != 0) leaf_against(leaf, group, near);
    });
  });
  list.count = cursor.count;
  return {tested, cursor.doubt.below(doubtful_below(tree.max_radius, job.radius_pad))};
}

/// A block against the bodies of a coarser tree: each of them in turn against the block.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult search_coarser_tree(const SearchJob<Cull>& job, const Tree<Cull>& coarser,
                                              const BlockLeaves<Cull>& leaves, Candidates& list,
                                              RoomMaker& room) {
  const BlockSearch<Shape> block{job, leaves.begin, list, room};
  Cursor<Shape> cursor(list);
  SearchResult found;
  each_node(coarser, coarser.levels - 1, 0, 0, 0, leaves.box, [&](std::uint32_t leaf) HWY_ATTR {
    const std::uint32_t first = coarser.begin + leaf * kTreeWidth;
    const std::uint32_t last = std::min(coarser.end, first + kTreeWidth);
    cursor = test_against(block, leaves, first, last, cursor, found);
  });
  list.count = cursor.count;
  return found;
}

/// A block of tree `number`.
template <class Shape, class Cull>
SearchResult search_trees(const SearchJob<Cull>& job, std::size_t number, std::uint32_t begin,
                          std::uint32_t end, Candidates& list, RoomMaker& room) {
  const Tree<Cull>& own = job.trees[number];
  SearchResult all = search_own_tree<Shape>(job, own, begin, end, list, room);
  const auto group = static_cast<std::uint32_t>((begin - own.begin) / kBlockBodies);
  const BlockLeaves<Cull> leaves = leaves_of(own, group, begin, end);
  for (std::size_t coarser = 0; coarser < number; ++coarser) {
    all += search_coarser_tree<Shape>(job, job.trees[coarser], leaves, list, room);
  }
  return all;
}
