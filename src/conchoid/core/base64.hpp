#pragma once

#include <string>
#include <string_view>

namespace conchoid {

/// Bytes as text (RFC 4648, with padding): four characters for three bytes.
std::string base64(std::string_view bytes);

}  // namespace conchoid
