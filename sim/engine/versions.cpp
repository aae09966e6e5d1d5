// See the header.
#include <sundials/sundials_version.h>

#include <sim/engine/versions.hpp>

namespace mckibben::engine {

std::string sundials_version() {
  char text[64] = "";
  SUNDIALSGetVersion(text, sizeof text);
  return text;
}

}  // namespace mckibben::engine
