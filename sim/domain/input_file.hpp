// A file that went into a result.
#pragma once

#include <string>

namespace mckibben::domain {

struct InputFile {
  std::string name;
  std::string sha256;  ///< of its bytes, in hexadecimal digits
};

}  // namespace mckibben::domain
