#include "conchoid/learn/boosting.hpp"

#include <algorithm>
#include <memory>
#include <mutex>

#include "conchoid/core/parallel.hpp"
#include "conchoid/learn/tree_module.hpp"

namespace conchoid {

std::vector<std::vector<BoostedMember>> fit_boosted_trees(std::span<const float> rows, std::size_t columns,
                                                          const std::vector<std::vector<float>>& targets,
                                                          const RunGroups& groups,
                                                          const BoostingSettings& settings,
                                                          const std::function<void()>& progress) {
  const auto members = static_cast<std::size_t>(groups.count);
  std::vector<std::vector<BoostedMember>> result(targets.size(), std::vector<BoostedMember>(members));
  std::unique_ptr<TreeGrower> grower;
  module_function<MakeTreeGrower>(kTreeModule, "conchoid_make_tree_grower", "training boosted trees")(
      rows, columns, {}, grower);
  std::mutex progress_mutex;
  parallel_for(targets.size() * members, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t job = begin; job < end; ++job) {
      const std::size_t target = job / members, member = job % members;
      std::vector<char> left_out(groups.of_row.size(), 0);
      if (members > 1)
        std::transform(groups.of_row.begin(), groups.of_row.end(), left_out.begin(),
                       [&](int g) { return static_cast<char>(g == static_cast<int>(member)); });
      result[target][member] = grower->boost(targets[target], left_out, settings);
      const std::lock_guard lock(progress_mutex);
      if (progress) progress();
    }
  });
  return result;
}

}  // namespace conchoid
