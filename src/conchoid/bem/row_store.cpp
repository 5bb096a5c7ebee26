#include "conchoid/bem/row_store.hpp"

#include <cstdint>

#include "conchoid/core/hash.hpp"

namespace conchoid {
namespace {

std::string name_of(const EnrichedSpace& space, const std::vector<std::size_t>& wanted) {
  ContentHash hash;
  for (const EnrichmentFunction& f : space.functions)
    hash.add(std::span<const double>(f.key));
  for (std::size_t w : wanted)
    hash.add(static_cast<std::uint64_t>(w));
  return hash.hex();
}

bool fits(const std::vector<EnrichmentRows>& rows, const EnrichmentProblem& problem,
          const EnrichedSpace& space, std::size_t wanted) {
  if (rows.size() != wanted) return false;
  const Unknowns& unknowns = problem.body.blocks().unknowns;
  for (const EnrichmentRows& r : rows)
    if (r.D_body.rows != 3 || r.D_body.columns != 3 * unknowns.displacement_count || r.D_enriched.rows != 3 ||
        r.D_enriched.columns != 3 * space.functions.size() || r.K.rows != 3 * unknowns.traction_count ||
        r.K.columns != 3)
      return false;
  return true;
}

}  // namespace

std::vector<EnrichmentRows> stored_rows(const EnrichmentProblem& problem, const EnrichedSpace& space,
                                        const std::vector<std::size_t>& wanted, RowStore* store) {
  if (!store || wanted.empty()) return assemble_enrichment_rows(problem, space, wanted);
  const std::string name = name_of(space, wanted);
  if (auto known = store->recall(name); known && fits(*known, problem, space, wanted.size()))
    return std::move(*known);
  std::vector<EnrichmentRows> rows = assemble_enrichment_rows(problem, space, wanted);
  store->keep(name, rows);
  return rows;
}

}  // namespace conchoid
