#include "app/pbstudy/prediction/run_errors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace pbmpi::app {

analysis::ErrorTable joined_errors(const nlohmann::json& tables, std::size_t first, std::size_t last) {
  analysis::ErrorTable all;
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    analysis::ErrorSummary& sum = all.*named.summary;
    sum = {};
    std::int64_t num_finite = 0;
    double squares = 0;
    for (std::size_t i = first; i < std::min(last, tables.size()); ++i) {
      const nlohmann::json& one = tables[i].at(std::string(named.name) + "_" + named.unit);
      const auto real = [&](const char* key) {
        return one.at(key).is_null() ? INFINITY : one.at(key).get<double>();
      };
      const auto count = one.at("count").get<std::int64_t>(), broken = one.at("broken").get<std::int64_t>();
      const std::int64_t finite = count - broken - one.at("bands").back().get<std::int64_t>();
      sum.count += count;
      sum.broken += broken;
      num_finite += finite;
      if (finite > 0) squares += static_cast<double>(finite) * real("rms") * real("rms");
      sum.max = std::max(sum.max, real("max"));
      for (std::size_t band = 0; band < sum.bands.size(); ++band)
        sum.bands[band] += one.at("bands")[band].get<std::int64_t>();
    }
    sum.rms = num_finite > 0 ? std::sqrt(squares / static_cast<double>(num_finite)) : 0;
    sum.p99 = NAN;
  }
  return all;
}

}  // namespace pbmpi::app
