#include "conchoid/core/byte_cache.hpp"

#include <bit>
#include <boost/interprocess/exceptions.hpp>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <cstdint>
#include <system_error>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/make_folder.hpp"

namespace conchoid {
namespace {

constexpr std::string_view kMagic = "CNCHKEPT";
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kAlignment = 64;

std::size_t up_to_alignment(std::size_t length) {
  return (kAlignment - length % kAlignment) % kAlignment;
}

KeptBytes mapped(const std::filesystem::path& path) {
  namespace ipc = boost::interprocess;
  try {
    if (std::filesystem::file_size(path) == 0) return {};
    const ipc::file_mapping file(path.c_str(), ipc::read_only);
    const auto region = std::make_shared<const ipc::mapped_region>(file, ipc::read_only);
    return {region, {static_cast<const char*>(region->get_address()), region->get_size()}};
  } catch (const ipc::interprocess_exception& e) {
    throw InputError(std::string("cannot be read (") + e.what() + ")");
  } catch (const std::filesystem::filesystem_error& e) {
    throw InputError(std::string("cannot be read (") + e.code().message() + ")");
  }
}

/// What is at the end of the file.
std::string_view content_of(std::string_view file, const std::string& name) {
  ByteReader in(file);
  if (in.get_raw(kMagic.size()) != kMagic) throw InputError("is not a file of this cache");
  if (in.get<std::uint32_t>() != kVersion) throw InputError("has another version");
  const auto hash = in.get<std::uint64_t>();
  if (in.get_text() != name) throw InputError("bears another's name");
  const auto length = in.get<std::uint64_t>();
  const std::string_view padding = in.get_raw(up_to_alignment(file.size() - in.left()));
  const std::string_view content = in.get_raw(length);
  if (in.left() > 0 || padding.find_first_not_of('\0') != std::string_view::npos ||
      hash_bytes(content) != hash)
    throw InputError("is damaged");
  return content;
}

}  // namespace

ByteCache::ByteCache(std::filesystem::path folder) : folder_(std::move(folder)) {
  make_folder(folder_, "--cache");
}

std::filesystem::path ByteCache::file_of(const std::string& name) const {
  return folder_ / (name + ".cache");
}

std::optional<KeptBytes> ByteCache::recall(const std::string& name) const {
  const std::filesystem::path file = file_of(name);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  const auto ignored = [&](const std::string& why) {
    warning(file.string() + ": " + why + "; what it should hold is made again and takes its place");
  };
  try {
    KeptBytes whole = mapped(file);
    return KeptBytes{std::move(whole.owner), content_of(whole.bytes, name)};
  } catch (const InputError& e) {
    ignored(e.what());
  } catch (const OutOfBytes&) {
    ignored("is cut short");
  }
  return std::nullopt;
}

void ByteCache::keep(const std::string& name, std::string_view bytes) const {
  ByteWriter out;
  out.put_raw(kMagic);
  out.put(kVersion);
  out.put(hash_bytes(bytes));
  out.put_text(name);
  out.put(static_cast<std::uint64_t>(bytes.size()));
  out.put_raw(std::string(up_to_alignment(out.bytes().size()), '\0'));
  out.put_raw(bytes);
  try {
    write_bytes(file_of(name), out.bytes());
  } catch (const InputError& e) {
    warning(std::string(e.what()) + "; nothing is kept in the cache");
  } catch (const WriteError& e) {
    warning(std::string(e.what()) + "; nothing is kept in the cache");
  }
}

std::string cache_name(const std::string& kind, std::string_view made_from) {
  ByteWriter all;
  all.put_text(CONCHOID_VERSION);
  all.put_text(__VERSION__);
  all.put(static_cast<std::uint32_t>(std::endian::native == std::endian::little));
#if defined(__x86_64__)  // by which BLAS and our own kernels choose their instructions
  for (const int has :
       {__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma"), __builtin_cpu_supports("avx512f")})
    all.put(static_cast<std::uint32_t>(has != 0));
#endif
  all.put_text(made_from);
  return kind + "-" + hex(hash_bytes(all.bytes(), 0)) + hex(hash_bytes(all.bytes(), 1));
}

}  // namespace conchoid
