// What libmatio opens and makes is closed and freed when it is done with.
#pragma once

#include <memory>

#include <matio.h>

namespace mckibben::formats {

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
using Mat = std::unique_ptr<mat_t, CloseMat>;

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

}  // namespace mckibben::formats
