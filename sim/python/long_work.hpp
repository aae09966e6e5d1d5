// Work that takes long: without Python's lock, in a thread of its own, so that meanwhile this one can hear
// Ctrl-C, tell progress, and let other threads of Python run. After Ctrl-C, or if whoever is told raises,
// the work is asked to stop and waited for, and the exception goes on.
#pragma once

#include <functional>
#include <utility>

#include <sim/python/module.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::python {

/// `progress`: None, or called as progress(what, done, total); of what comes too fast, with the latest.
void do_long(const py::object& progress, const std::function<void(const run::ProgressHook&)>& work);

template <class Work>
auto long_work(const py::object& progress, const Work& work) {
  std::optional<std::invoke_result_t<Work, const run::ProgressHook&>> result;
  do_long(progress, [&](const run::ProgressHook& hook) { result.emplace(work(hook)); });
  return *std::move(result);
}

}  // namespace mckibben::python
