#pragma once

// The state behind harpoon::Workspace.

#include <memory>

#include "base/executor.hpp"
#include "harpoon/scene.hpp"
#include "scene/boxes.hpp"
#include "scene/id_order.hpp"
#include "scene/order.hpp"
#include "scene/search.hpp"
#include "scene/tree.hpp"

namespace harpoon {

struct Workspace::State {
  const scene::KernelTable* kernels = nullptr;
  std::unique_ptr<Executor> executor;  ///< null for one thread
  scene::OrderMemory order;
  scene::TreeMemory trees;
  scene::BoxMemory boxes;
  scene::SearchMemory search;
  scene::IdOrderMemory by_id;
  scene::Buffer scratch;  ///< of the writers of output

  [[nodiscard]] scene::Means means(std::size_t bodies) const noexcept;
};

}  // namespace harpoon
