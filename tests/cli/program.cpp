// See the header.
#include "program.hpp"

#include <fstream>
#include <sstream>

#include <sys/wait.h>

namespace mckibben::cli {
namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).generic_string()] = read_text(entry.path());
  return files;
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Said mckibben(const std::string& arguments, const fs::path& folder) {
  return shell("\"$M\" " + arguments, folder);
}

Said shell(const std::string& script, const fs::path& folder) {
  const Scratch said;
  const std::string command = "cd '" + folder.string() + "' && M='" MCKIBBEN_PROGRAM "' && { " + script +
                              "; } > '" + (said / "out").string() + "' 2> '" + (said / "err").string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(said / "out"), read_text(said / "err")};
}

}  // namespace mckibben::cli
