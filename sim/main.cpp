// The program. All it does stands in sim/cli.
#include <sim/cli/cli.hpp>

int main(int argc, char** argv) {
  return mckibben::cli::run(argc, argv);
}
