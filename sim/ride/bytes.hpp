// A state as bytes and back, of FMUs (FMI 2.0 section 2.1.8, and 3.0 alike) and of Python's pickles: each
// member in turn, as it lies in memory. So bytes are of one build, on machines of one kind; a sum at their
// end shows others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace mckibben::ride {

/// What is made of members, what grows, what may lack, and what lies in memory as it is.
template <class T, class Visitor>
concept HasMembers = requires(T& value, Visitor& visit) {
  T::members(value, visit);
};
template <class T>
concept Grows = requires(T& value) {
  value.resize(0);
};
template <class T>
concept MayLack = requires(T& value) {
  value.reset();
  value.has_value();
};

/// Of the bytes before (FNV-1a, 64 bits).
inline std::uint64_t sum_of(std::string_view bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return sum;
}

class BytesWriter {
 public:
  void operator()(const auto&... values) { (write(values), ...); }

  std::string closed() {
    write(sum_of(bytes_));
    return std::move(bytes_);
  }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (HasMembers<const T, BytesWriter>) {
      T::members(value, *this);
    } else if constexpr (Grows<T>) {
      write(value.size());
      for (const auto& each : value) write(each);
    } else if constexpr (MayLack<T>) {  // what it lacks is whatever memory held
      write(static_cast<std::uint8_t>(value.has_value()));
      if (value) write(*value);
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      T plain = value;
#if defined(__GNUC__) && !defined(__clang__)
      __builtin_clear_padding(&plain);  // else the same state has other bytes each time
#endif
      bytes_.append(reinterpret_cast<const char*>(&plain), sizeof plain);
    }
  }

  std::string bytes_;
};

/// Throws std::runtime_error where bytes are not those that were written.
class BytesReader {
 public:
  explicit BytesReader(std::string_view bytes) : rest_(bytes) {
    std::uint64_t sum = 0;
    if (bytes.size() < sizeof sum) fail();
    rest_.remove_suffix(sizeof sum);
    std::memcpy(&sum, bytes.data() + rest_.size(), sizeof sum);
    if (sum != sum_of(rest_)) fail();
  }

  void operator()(auto&... values) { (read(values), ...); }

  void end() const {
    if (!rest_.empty()) fail();
  }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (HasMembers<T, BytesReader>) {
      T::members(value, *this);
    } else if constexpr (Grows<T>) {
      std::size_t size = 0;
      read(size);
      if (size > rest_.size()) fail();  // each takes a byte at least
      value.resize(size);
      for (auto& each : value) read(each);
    } else if constexpr (MayLack<T>) {
      std::uint8_t is_there = 0;
      read(is_there);
      value.reset();
      if (is_there != 0) read(value.emplace());
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      if (rest_.size() < sizeof value) fail();
      std::memcpy(&value, rest_.data(), sizeof value);
      rest_.remove_prefix(sizeof value);
    }
  }

  [[noreturn]] static void fail() { throw std::runtime_error("these bytes are not those that were written"); }

  std::string_view rest_;
};

}  // namespace mckibben::ride
