// Results as bytes, for other processes of the same program on the same kind of machine, or for when it goes
// on: members one after the other, which one list names for both ways.
#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mckibben::run {

class Packer {
 public:
  explicit Packer(std::string& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const T& value) { (*this)(std::span(&value, 1)); }
  /// As many as there are.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::span<T> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(list.size());
    (*this)(std::span(list));
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes_ += text;
  }

 private:
  std::string& bytes_;
};

/// Throws std::invalid_argument if there are too few bytes.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { (*this)(std::span(&value, 1)); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::span<T> values) {
    const std::string_view from = next(values.size_bytes());
    if (!from.empty()) std::memcpy(static_cast<void*>(values.data()), from.data(), from.size());
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    list.resize(size_of_list(sizeof(T)));
    (*this)(std::span(list));
  }
  void operator()(std::string& text) { text = next(size_of_list(1)); }

  std::size_t size_of_list(std::size_t each) {
    std::size_t count = 0;
    (*this)(count);
    if (count > rest_.size() / each) throw std::invalid_argument("packed results are too short");
    return count;
  }
  bool end() const { return rest_.empty(); }

 private:
  std::string_view next(std::size_t size) {
    if (size > rest_.size()) throw std::invalid_argument("packed results are too short");
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }

  std::string_view rest_;
};

/// `members`: visits those of a value, the same to be packed and to be filled.
template <class Value, class Members>
std::string packed(const Value& value, const Members& members) {
  std::string bytes;
  members(Packer(bytes), value);
  return bytes;
}

/// What `packed` made. Throws std::invalid_argument if the bytes are not that.
template <class Value, class Members>
void unpack(std::string_view bytes, Value& value, const Members& members) {
  Unpacker unpacker(bytes);
  members(unpacker, value);
  if (!unpacker.end()) throw std::invalid_argument("packed results are too long");
}

}  // namespace mckibben::run
