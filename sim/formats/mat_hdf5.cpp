// By HDF5's C library, from the bytes at hand, in a process of its own; see the header. Structs are groups,
// arrays of structs are datasets of references, texts are numbers with the class `char`.
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

#include <sim/formats/isolated.hpp>
#include <sim/formats/mat_arrays.hpp>
#include <sim/formats/mat_hdf5.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t most_found = 10000, most_structs = 1000, before_hdf5_bytes = 512;
constexpr int deepest_group = 20;

/// An identifier of HDF5 and how it is given back.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A numeric dataset: rows and columns as MATLAB has them.
struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values{};
};

class Reader {
 public:
  explicit Reader(const std::string& bytes)
      : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), file_(open(bytes), H5Fclose) {
    if (file_ < 0) throw BadFile("this looks like a MAT-file of -v7.3 (HDF5), and it is damaged or cut off");
    const Handle root(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose);
    group(root, "", "", 0);
  }
  MatContents contents;
  std::map<std::string, Matrix> matrices;

 private:
  hid_t open(const std::string& bytes) {
    constexpr std::size_t grow = 1U << 16U;
    H5Pset_fapl_core(access_, grow, 0);
    H5Pset_file_image(access_, const_cast<char*>(bytes.data()), bytes.size());
    return H5Fopen("mat", H5F_ACC_RDONLY, access_);
  }

  static std::vector<std::string> names_in(hid_t group) {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
      auto& found = *static_cast<std::vector<std::string>*>(list);
      if (found.size() == most_found) return 1;
      found.emplace_back(name);
      return 0;
    };
    H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
    return names;
  }

  void group(hid_t of, const std::string& path, const std::string& label, int depth) {
    if (depth > deepest_group) return;
    const std::vector<std::string> names = names_in(of);
    std::string own = label;
    for (const std::string& name : names)
      if (name == "label" || name == "signalName")
        if (const Handle object(H5Oopen(of, name.c_str(), H5P_DEFAULT), H5Oclose); object >= 0)
          if (std::string text = text_of(object); !text.empty()) own = std::move(text);
    for (const std::string& name : names) {
      if (name.starts_with('#') || contents.names.size() >= most_found)
        continue;  // what only references lead to
      const Handle object(H5Oopen(of, name.c_str(), H5P_DEFAULT), H5Oclose);
      if (object >= 0)
        take(object, path.empty() ? name : path + "." + name, name == "time" ? "" : own, depth + 1);
    }
  }

  void take(hid_t object, const std::string& path, const std::string& label, int depth) {
    const H5I_type_t kind = H5Iget_type(object);
    if (H5Aexists(object, "MATLAB_object_decode") > 0) {
      contents.objects.push_back(about_object(path, class_of(object)));
      return;
    }
    if (kind == H5I_GROUP) return group(object, path, label, depth);
    if (kind != H5I_DATASET) return;
    const Handle type(H5Dget_type(object), H5Tclose);
    const H5T_class_t numbers = H5Tget_class(type);
    if (numbers == H5T_REFERENCE) return structs(object, path, label, depth);
    if ((numbers == H5T_INTEGER || numbers == H5T_FLOAT) && class_of(object) != "char")
      dataset(object, path, label);
  }

  static std::pair<std::size_t, std::size_t> size_of(hid_t dataset) {
    const Handle space(H5Dget_space(dataset), H5Sclose);
    if (H5Sget_simple_extent_ndims(space) != 2) return {0, 0};
    hsize_t sizes[2];
    H5Sget_simple_extent_dims(space, sizes, nullptr);
    if (sizes[0] > most_numbers || sizes[1] > most_numbers || sizes[0] * sizes[1] > most_numbers)
      return {0, 0};
    return {sizes[1], sizes[0]};
  }

  void dataset(hid_t object, const std::string& path, const std::string& label) {
    const auto [rows, columns] = size_of(object);
    total_ += rows * columns;
    if (rows * columns == 0 || total_ > most_numbers) return;
    Matrix matrix{rows, columns, std::vector<double>(rows * columns)};
    if (H5Dread(object, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, matrix.values.data()) < 0)
      throw BadFile(fmt::format("{} cannot be read: the file is damaged or cut off", path));
    contents.add(path, label, rows, columns);
    matrices.emplace(path, std::move(matrix));
  }

  /// A field of an array of structs: a reference for each of them.
  void structs(hid_t object, const std::string& path, const std::string& label, int depth) {
    const auto [rows, columns] = size_of(object);
    const std::size_t count = rows * columns, dot = path.rfind('.');
    if (depth > deepest_group || count == 0 || count > most_structs || dot == std::string::npos) return;
    std::vector<hobj_ref_t> references(count);
    if (H5Dread(object, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data()) < 0) return;
    for (std::size_t i = 0; i < count; ++i) {
      const Handle inside(H5Rdereference2(object, H5P_DEFAULT, H5R_OBJECT, &references[i]), H5Oclose);
      const std::string of = fmt::format("{}({})", path.substr(0, dot), i + 1);
      if (inside < 0) continue;
      if (path.substr(dot) == ".label") {
        labels_[of] = text_of(inside);
        continue;
      }
      const auto known = labels_.find(of);
      take(inside, of + path.substr(dot), known == labels_.end() ? label : known->second, depth + 1);
    }
  }

  static std::string class_of(hid_t object) {
    if (H5Aexists(object, "MATLAB_class") <= 0) return "";
    const Handle attribute(H5Aopen(object, "MATLAB_class", H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const std::size_t size = H5Tget_size(type);
    constexpr std::size_t longest = 100;
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size == 0 || size > longest)
      return "";
    std::string text(size, '\0');
    if (H5Aread(attribute, type, text.data()) < 0) return "";
    return text.substr(0, text.find('\0'));
  }

  static std::string text_of(hid_t object) {
    if (H5Iget_type(object) != H5I_DATASET || class_of(object) != "char") return "";
    constexpr std::size_t longest = 200;
    const auto [rows, columns] = size_of(object);
    if (rows * columns == 0 || rows * columns > longest) return "";
    std::vector<unsigned short> letters(rows * columns);
    if (H5Dread(object, H5T_NATIVE_USHORT, H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data()) < 0) return "";
    std::string text;
    for (const unsigned short letter : letters)
      text += letter >= ' ' && letter < 0x7F ? static_cast<char>(letter) : '?';
    return text;
  }

  Handle access_, file_;
  std::map<std::string, std::string> labels_;
  std::size_t total_ = 0;
};

Found found_in(const Reader& reader, const std::string& where) {
  const auto [name, column] = split_column(where);
  const std::string path(name);
  for (const std::string& object : reader.contents.objects)
    if (const std::string of = object.substr(0, object.find(' ')); path == of || path.starts_with(of + "."))
      return {{}, object};
  const auto matrix = reader.matrices.find(path);
  if (matrix == reader.matrices.end()) return {{}, fmt::format("there is no variable {} of numbers", path)};
  const auto& [rows, columns, values] = matrix->second;
  if (column > columns) return {{}, fmt::format("{} has {} columns", path, columns)};
  if (column == 0 && rows > 1 && columns > 1)
    return {{}, fmt::format("{} has {} rows and {} columns; name one: {}(:,1)", path, rows, columns, path)};
  if (column == 0) return {values, ""};
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>((column - 1) * rows);
  return {{begin, begin + static_cast<std::ptrdiff_t>(rows)}, ""};
}

}  // namespace

bool is_mat_hdf5(const std::string& bytes) {
  constexpr std::string_view mark = "\x89HDF\r\n\x1A\n";
  return bytes.starts_with(mark) ||
         (bytes.size() > before_hdf5_bytes && bytes.compare(before_hdf5_bytes, mark.size(), mark) == 0);
}

MatContents read_mat_hdf5(const std::string& bytes, const std::vector<std::string>& wanted) {
  const std::vector<std::string> parts = isolated([&] {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors of damaged files are ours to tell
    const Reader reader(bytes);
    std::vector<std::string> all;
    for (const std::string& where : wanted) {
      Found found;
      try {
        found = found_in(reader, where);
      } catch (const BadFile& bad) {
        found.problem = bad.what();
      }
      all.emplace_back(reinterpret_cast<const char*>(found.values.data()),
                       found.values.size() * sizeof(double));
      all.push_back(found.problem);
    }
    all.push_back(std::to_string(reader.contents.names.size()));
    all.insert(all.end(), reader.contents.names.begin(), reader.contents.names.end());
    for (const auto& [name, label] : reader.contents.vectors) all.insert(all.end(), {name, label});
    return all;
  });
  MatContents contents;
  auto part = parts.begin();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Found& found = contents.found.emplace_back();
    found.values.resize(part->size() / sizeof(double));
    std::ranges::copy(*part++, reinterpret_cast<char*>(found.values.data()));
    found.problem = *part++;
  }
  const auto names = part + 1, end_of_names = names + std::stol(*part);
  contents.names.assign(names, end_of_names);
  for (part = end_of_names; part != parts.end(); part += 2) contents.vectors.push_back({part[0], part[1]});
  return contents;
}

}  // namespace mckibben::formats
