// Members one after the other, in one list for both ways; see the header.
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <sim/run/packed.hpp>

namespace mckibben::run {
namespace {

class Packer {
 public:
  explicit Packer(std::string& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const T& value) { append(&value, 1); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const std::vector<T>& list) {
    (*this)(list.size());
    append(list.data(), list.size());
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes_ += text;
  }

  bool reads = false;

 private:
  template <class T>
  void append(const T* first, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(first), count * sizeof(T));
  }

  std::string& bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { std::memcpy(static_cast<void*>(&value), next(sizeof(T)), sizeof(T)); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& list) {
    const std::size_t count = size_of_list(sizeof(T));
    list.resize(count);
    const char* from = next(count * sizeof(T));
    if (count > 0) std::memcpy(static_cast<void*>(list.data()), from, count * sizeof(T));
  }
  void operator()(std::string& text) {
    const std::size_t count = size_of_list(1);
    text.assign(next(count), count);
  }
  void end() const {
    if (at_ != bytes_.size()) throw std::invalid_argument("packed results are too long");
  }

  bool reads = true;

  std::size_t size_of_list(std::size_t each) {
    std::size_t count = 0;
    (*this)(count);
    if (count > (bytes_.size() - at_) / each) throw std::invalid_argument("packed results are too short");
    return count;
  }

 private:
  const char* next(std::size_t size) {
    if (size > bytes_.size() - at_) throw std::invalid_argument("packed results are too short");
    at_ += size;
    return bytes_.data() + at_ - size;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class Visitor, class Findings>
void visit_findings(Visitor& visit, Findings& findings) {
  std::size_t count = findings.size();
  visit(count);
  if constexpr (requires { findings.resize(count); }) {
    if (visit.reads) findings.resize(count);
  }
  for (auto& finding : findings) {
    visit(finding.name);
    visit(finding.unit);
    visit(finding.value);
  }
}

template <class Visitor, class Of>
void visit_members(Visitor& visit, Of& of) {
  if constexpr (std::is_same_v<std::remove_const_t<Of>, TrackedRun>) {
    visit(of.load_kg);
    visit(of.controller);
    auto& recording = of.recording;
    visit(recording.samples);
    visit(recording.ledger);
    visit(recording.imbalance);
    visit(recording.solver);
    visit(recording.largest_contraction_ratio);
    visit(recording.failure);
    visit_findings(visit, recording.findings);
    visit(recording.driven);
    visit(recording.slack);
    visit(of.metrics);
    visit(of.failure);
    visit(of.unreachable);
    visit(of.limits);
    visit(of.id);
    visit(of.name);
    visit(of.target);
    visit(of.joint);
  } else {
    visit(of.controller);
    visit(of.load_kg);
    visit(of.tuned);
    visit(of.failure);
    visit(of.idle_cost);
    visit(of.metrics);
    visit(of.limits);
  }
}

template <class T>
std::string bytes_of(const T& value) {
  std::string bytes;
  Packer pack(bytes);
  visit_members(pack, value);
  return bytes;
}

template <class T>
T value_of_bytes(const std::string& bytes) {
  T value;
  Unpacker unpack(bytes);
  visit_members(unpack, value);
  unpack.end();
  return value;
}

}  // namespace

std::string packed(const TrackedRun& run) {
  return bytes_of(run);
}
std::string packed(const TunedController& tuned) {
  return bytes_of(tuned);
}
TrackedRun unpacked_run(const std::string& bytes) {
  return value_of_bytes<TrackedRun>(bytes);
}
TunedController unpacked_tuning(const std::string& bytes) {
  return value_of_bytes<TunedController>(bytes);
}

}  // namespace mckibben::run
