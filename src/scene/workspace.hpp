#pragma once

// The state behind harpoon::Workspace.

#include <memory>

#include "base/executor.hpp"
#include "broad/boxes.hpp"
#include "broad/id_order.hpp"
#include "broad/order.hpp"
#include "broad/search.hpp"
#include "broad/tree.hpp"
#include "harpoon/scene.hpp"

namespace harpoon {

struct Workspace::State {
  const broad::KernelTable* kernels = nullptr;
  std::unique_ptr<Executor> executor;  ///< null for one thread
  broad::OrderMemory order;
  broad::TreeMemory trees;
  broad::BoxMemory boxes;
  broad::SearchMemory search;
  broad::IdOrderMemory by_id;
  Buffer scratch;  ///< of the writers of output

  [[nodiscard]] broad::Means means(std::size_t bodies) const noexcept;
};

}  // namespace harpoon
