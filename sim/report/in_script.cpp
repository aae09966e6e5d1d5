// See the header.
#include <sim/report/in_script.hpp>

namespace mckibben::report {

std::string in_script(const input::Json& data) {
  std::string text;
  for (const char c : data.dump())
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

}  // namespace mckibben::report
