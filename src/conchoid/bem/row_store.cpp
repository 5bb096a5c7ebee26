#include "conchoid/bem/row_store.hpp"

#include <algorithm>
#include <cstdint>

#include "conchoid/core/hash.hpp"

namespace conchoid {
namespace {

std::string name_of(const EnrichedSpace& space, std::span<const LoadSource> sources,
                    const std::vector<std::size_t>& wanted) {
  ContentHash hash;
  for (const EnrichmentFunction& f : space.functions)
    hash.add(std::span<const double>(f.key));
  for (std::size_t w : wanted)
    hash.add(static_cast<std::uint64_t>(w));
  for (const LoadSource& s : sources) {
    hash.add(static_cast<std::uint64_t>(s.kind));
    hash.add(static_cast<std::uint64_t>(s.index));
  }
  return hash.hex();
}

bool has_size(const DenseMatrix& m, std::size_t columns) {
  return m.rows == 3 && m.columns == columns && m.data.size() == 3 * columns;
}

bool fits(const std::vector<EnrichmentRows>& rows, const CrackHost& host, const EnrichedSpace& space,
          std::size_t sources, std::size_t wanted) {
  return rows.size() == wanted && std::all_of(rows.begin(), rows.end(), [&](const EnrichmentRows& r) {
           return has_size(r.body, host.unknowns()) && has_size(r.enriched, 3 * space.functions.size()) &&
                  has_size(r.sources, 3 * sources);
         });
}

}  // namespace

std::vector<EnrichmentRows> stored_rows(const CrackHost& host, const EnrichedSpace& space,
                                        std::span<const LoadSource> sources,
                                        const std::vector<std::size_t>& wanted, RowStore* store,
                                        PairMemory& memory) {
  if (!store || wanted.empty()) return host.rows(space, sources, wanted, &memory);
  const std::string name = name_of(space, sources, wanted);
  if (auto known = store->recall(name); known && fits(*known, host, space, sources.size(), wanted.size()))
    return std::move(*known);
  std::vector<EnrichmentRows> rows = host.rows(space, sources, wanted, &memory);
  store->keep(name, rows);
  return rows;
}

}  // namespace conchoid
