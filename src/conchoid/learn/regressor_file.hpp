#pragma once

#include <string>
#include <string_view>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// The file of a regressor, layout in regressor_file.cpp; load_regressor() reads it back.
/// @param kind      name in the list of kinds
/// @param settings  text of a JSON object; its keys must not be those of the record
/// @param fit       what the kind's reader takes
std::string regressor_bytes(std::string_view kind, const TrainingRecord& record, const std::string& settings,
                            std::string_view fit);

}  // namespace conchoid
