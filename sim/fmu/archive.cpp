// The archive in memory; see the header. What every FMU holds (program and sources) is itself a ZIP archive,
// made when we were built, which this file carries (cmake/fmu_parts.cmake).
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <zip.h>

#include <sim/fmu/archive.hpp>
#include <sim/fmu/model/instance.hpp>
#include <sim/fmu/model/rig_text.hpp>
#include <sim/input/hash.hpp>

asm(".section .rodata\n"
    ".global mckibben_fmu_parts\nmckibben_fmu_parts:\n.incbin \"" MCKIBBEN_FMU_PARTS
    "\"\n"
    ".global mckibben_fmu_parts_end\nmckibben_fmu_parts_end:\n"
    ".byte 0\n.previous\n");
extern "C" {
extern const char mckibben_fmu_parts[], mckibben_fmu_parts_end[];
}

namespace mckibben::fmu {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("cannot make the archive: ") + what);
}

using Archive = std::unique_ptr<zip_t, void (*)(zip_t*)>;

/// An archive in memory; `bytes` must live as long.
Archive opened(zip_source_t* bytes, int flags) {
  zip_error_t error;
  zip_error_init(&error);
  zip_t* const archive = zip_open_from_source(bytes, flags, &error);
  if (archive == nullptr) fail(zip_error_strerror(&error));
  return {archive, zip_discard};
}

/// Adds a file; times are left out, so that nothing but the contents decides on the bytes.
void add(zip_t* archive, const std::string& name, std::string_view content) {
  zip_source_t* const source = zip_source_buffer(archive, content.data(), content.size(), 0);
  if (source == nullptr) fail(zip_strerror(archive));
  const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  constexpr zip_uint16_t midnight = 0, first_of_1980 = 0x21;
  if (index < 0 ||
      zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), midnight, first_of_1980, 0) != 0)
    fail(zip_strerror(archive));
}

std::string content_of(zip_t* archive, zip_uint64_t index, std::string& name) {
  zip_stat_t about;
  if (zip_stat_index(archive, index, 0, &about) != 0) fail(zip_strerror(archive));
  name = about.name;
  std::string content(about.size, '\0');
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive, index, 0),
                                                               zip_fclose);
  if (!file ||
      zip_fread(file.get(), content.data(), content.size()) != static_cast<zip_int64_t>(content.size()))
    fail(zip_strerror(archive));
  return content;
}

struct File {
  std::string name, content;
};

std::vector<File> parts(Version version) {
  const std::size_t size = static_cast<std::size_t>(mckibben_fmu_parts_end - mckibben_fmu_parts);
  zip_error_t error;
  zip_source_t* const source = zip_source_buffer_create(mckibben_fmu_parts, size, 0, &error);
  if (source == nullptr) fail(zip_error_strerror(&error));
  const Archive archive = opened(source, ZIP_RDONLY);
  constexpr std::string_view program = "binaries/";
  std::vector<File> files;
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(zip_get_num_entries(archive.get(), 0)); ++i) {
    File file;
    file.content = content_of(archive.get(), i, file.name);
    if (file.name.ends_with('/')) continue;
    if (file.name.starts_with(program))
      file.name.insert(program.size(), version == Version::two ? "linux64/" : "x86_64-linux/");
    if (file.name == "sources/buildDescription.xml" && version == Version::two) continue;
    files.push_back(std::move(file));
  }
  return files;
}

/// In the form of the identifiers that importers are used to.
std::string token_of(const std::string& all) {
  const std::string digits = input::sha256_hex(all);
  return '{' + digits.substr(0, 8) + '-' + digits.substr(8, 4) + '-' + digits.substr(12, 4) + '-' +
         digits.substr(16, 4) + '-' + digits.substr(20, 12) + '}';
}

std::string packed(const std::vector<File>& files) {
  zip_error_t error;
  zip_source_t* const source = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (source == nullptr) fail(zip_error_strerror(&error));
  zip_source_keep(source);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> bytes(source, zip_source_free);
  Archive archive = opened(source, ZIP_CREATE | ZIP_TRUNCATE);
  for (const File& file : files) add(archive.get(), file.name, file.content);
  if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
  std::ignore = archive.release();
  zip_stat_t about;
  if (zip_source_stat(source, &about) != 0 || zip_source_open(source) != 0) fail("it cannot be read again");
  std::string content(about.size, '\0');
  const zip_int64_t read = zip_source_read(source, content.data(), content.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(content.size())) fail("it cannot be read again");
  return content;
}

}  // namespace

std::string fmu_of(const std::string& name, const plant::Rig& rig, Version version, bool true_states) {
  Contents contents{"", rig};
  Description about{version, name, "", true_states};
  about.token = contents.token = token_of(MCKIBBEN_VERSION + text_of(contents) + description_xml(about, rig));
  std::vector<File> files{{"modelDescription.xml", description_xml(about, rig)},
                          {std::string("resources/") + rig_file, text_of(contents)}};
  for (File& part : parts(version)) files.push_back(std::move(part));
  return packed(files);
}

}  // namespace mckibben::fmu
