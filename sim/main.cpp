// The program. All it does stands in sim/cli.
#include <sim/cli/cli.hpp>
#include <sim/cli/streams.hpp>

int main(int argc, char** argv) {
  mckibben::cli::prepare_streams();
  return mckibben::cli::run(argc, argv);
}
