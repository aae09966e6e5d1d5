// A shared library, opened once for each run; see the header.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <dlfcn.h>
#include <unistd.h>

#include <controllers/line.hpp>
#include <controllers/mckibben_controller.h>
#include <controllers/plugin.hpp>

namespace mckibben::controllers {
namespace {

constexpr int version_for_mA = 1;  // did not tell the unit

/// While the code of a library runs. If it calls exit(), the program must not end as if all had gone well.
class Inside {
 public:
  explicit Inside(const std::filesystem::path& library) {
    static const int once = std::atexit([] {
      if (library_ == nullptr) return;
      std::fprintf(stderr, "mckibben: the library %s has called exit()\n", library_);
      constexpr int defect = 70;
      _exit(defect);
    });
    static_cast<void>(once);
    library_ = library.c_str();
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside() { library_ = nullptr; }

 private:
  static thread_local const char* library_;
};
thread_local const char* Inside::library_ = nullptr;

/// A library as long as somebody uses it.
class Library {
 public:
  explicit Library(const std::string& path) : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) throw ControllerFailure(std::string("its library cannot be used: ") + dlerror());
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { dlclose(handle_); }

  template <class Function>
  void find(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(dlsym(handle_, name));
    if (function == nullptr) throw ControllerFailure(std::string("its library has no ") + name);
  }

 private:
  void* handle_;
};

class Plugin final : public Guest {
 public:
  Plugin(const PluginSettings& settings, const Knowledge& known)
      : Guest(settings, known),
        path_(std::filesystem::absolute(std::filesystem::path(settings.folder) / settings.library)),
        settings_(settings.settings) {}
  ~Plugin() override {
    const Inside library(path_);
    if (self_ != nullptr) close_(self_);
    library_.reset();
  }

 private:
  double begin_mA() override {
    const Inside library(path_);
    load();
    const mckibben_controller_hello hello{
        .period_s = known().tick_s,
        .contraction_per_count = known().contraction_per_count,
        .middle_of_count = known().middle_of_count,
        .rest_length_m = known().model.rest_length_m,
        .lowest_mA = range().lowest_mA,
        .highest_mA = range().highest_mA,
        .largest_current_speed_mA_per_s =
            terms().largest_current_speed_mA_per_s.value_or(std::numeric_limits<double>::infinity()),
        .load_kg = known().load_kg.value_or(std::numeric_limits<double>::quiet_NaN()),
        .preparation_ticks = preparation_ticks(),
        .target = known().target.data(),
        .target_ticks = known().target.size(),
        .settings = settings_.c_str(),
        .command_unit = known().valve.unit.data()};
    self_ = open_(&hello, why_.data());
    if (self_ == nullptr) throw ControllerFailure("its library refuses: " + why());
    return rest_(self_);
  }

  double answer_mA(const Told& told) override {
    const mckibben_controller_reading reading{told.reading.tick, told.reading.time_s, told.reading.counts,
                                              told.counts_lost ? 1 : 0, told.target};
    double current_mA = std::numeric_limits<double>::quiet_NaN();
    const Inside library(path_);
    if (step_(self_, &reading, &current_mA, why_.data()) != 0)
      throw ControllerFailure("its library refuses: " + why());
    return current_mA;
  }

  void load() {
    library_ = std::make_unique<Library>(path_.string());
    decltype(mckibben_controller_version)* version = nullptr;
    library_->find(version, "mckibben_controller_version");
    if (const int its = version(); its == version_for_mA && known().valve.unit != "mA")
      throw ControllerFailure(
          "its library is for version 1 of the interface, whose commands are in mA; here "
          "they are in " +
          std::string(known().valve.unit));
    else if (its != MCKIBBEN_CONTROLLER_VERSION && its != version_for_mA)
      throw ControllerFailure("its library is for version " + std::to_string(its) +
                              " of the interface, not " + std::to_string(MCKIBBEN_CONTROLLER_VERSION));
    library_->find(open_, "mckibben_controller_open");
    library_->find(rest_, "mckibben_controller_rest");
    library_->find(step_, "mckibben_controller_step");
    library_->find(close_, "mckibben_controller_close");
  }

  std::string why() {
    why_.back() = '\0';
    return in_quotes(why_.data());
  }

  std::filesystem::path path_;
  std::string settings_;
  std::array<char, MCKIBBEN_CONTROLLER_WHY> why_{};
  std::unique_ptr<Library> library_;
  decltype(mckibben_controller_open)* open_ = nullptr;
  decltype(mckibben_controller_rest)* rest_ = nullptr;
  decltype(mckibben_controller_step)* step_ = nullptr;
  decltype(mckibben_controller_close)* close_ = nullptr;
  void* self_ = nullptr;
};

}  // namespace

std::unique_ptr<Controller> PluginSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<Plugin>(*this, knowledge);
}

}  // namespace mckibben::controllers
