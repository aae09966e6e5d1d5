// A fuzz target without clang's fuzzer: replays its corpus,
// then as many seeded mutations of it as are wanted.
//   fuzz_replay TARGET MUTATIONS SEED CORPUS [FOLDER...]      the files of FOLDERs are replayed only
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "mutator.hpp"
#include "targets.hpp"

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_in(char** first, char** last) {
  std::vector<fs::path> files;
  for (; first < last; ++first)
    for (const auto& entry : fs::recursive_directory_iterator(*first))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());  // the order of a folder is the machine's
  return files;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

int main(int count, char** arguments) {
  const auto target = count < 5 ? nullptr : mckibben::fuzz::find_target(arguments[1]);
  if (target == nullptr) {
    std::cerr << "usage: fuzz_replay TARGET MUTATIONS SEED CORPUS [FOLDER...]\n";
    return 64;
  }
  const std::vector<fs::path> files = files_in(arguments + 4, arguments + count),
                              corpus = files_in(arguments + 4, arguments + 5);
  const unsigned long mutations = std::stoul(arguments[2]), seed = std::stoul(arguments[3]);
  std::cout << arguments[1] << ": " << files.size() << " files, " << mutations << " mutations from seed "
            << seed << std::endl;
  std::string what;
  try {
    for (const fs::path& file : files) {
      what = file.string();
      target(bytes_of(file));
    }
    for (unsigned long i = 0; i < mutations && !corpus.empty(); ++i) {
      const fs::path& file = corpus[i % corpus.size()];
      what = file.string() + ", seed " + std::to_string(seed + i);
      if (i % 100 == 0) std::cout << what << std::endl;  // where to look after a crash
      mckibben::Mutator mutator(static_cast<unsigned>(seed + i));
      target(i % 2 == 0 ? mutator.mutated(bytes_of(file)) : mutator.mangled(bytes_of(file)));
    }
  } catch (const std::exception& error) {
    std::cerr << what << ": " << error.what() << '\n';
    return 1;
  }
  return corpus.empty() ? 1 : 0;
}
