#include "c/ccdt.h"

#include <array>
#include <atomic>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/platform.h"
#include "engine/include/ccdt/ccdt.h"
#include "engine/options/set_option.h"

struct ccdt_surface {
  ccdt::InputPlc plc;
};

struct ccdt_options {
  ccdt::MeshOptions options;
  const int* cancel_flag = nullptr;
};

struct ccdt_mesh {
  ccdt::TetMesh mesh;
};

namespace {

using ccdt::InputError, ccdt::Place, ccdt::Point3;

struct Canceled : std::exception {};
struct NullPointer : std::exception {};

struct LastError {
  std::string text, remedy;
  Place place;
};
thread_local LastError last_error;

/// Without memory for the texts, the status alone remains.
void note(const char* text, const char* remedy, const Place& place) noexcept {
  try {
    last_error = {text, remedy, place};
  } catch (const std::bad_alloc&) {
    last_error = {};
  }
}

ccdt_status fail(ccdt_status status, const char* text, const char* remedy = "") {
  note(text, remedy, {});
  return status;
}

ccdt_status fail(const ccdt::Error& error) {
  note(error.what(), error.remedy().c_str(), error.place());
  if (dynamic_cast<const ccdt::LimitError*>(&error) != nullptr) return CCDT_LIMIT_REACHED;
  return dynamic_cast<const ccdt::MeshError*>(&error) != nullptr ? CCDT_NO_MESH : CCDT_BAD_INPUT;
}

/// Runs something and turns its exceptions into a status. No exception reaches C.
template <class Run>
ccdt_status guarded(const Run& run) {
  try {
    run();
    return CCDT_DONE;
  } catch (const ccdt::Error& error) {
    return fail(error);
  } catch (const Canceled&) {
    return fail(CCDT_CANCELED, "the work was canceled");
  } catch (const NullPointer&) {
    return fail(CCDT_BAD_CALL, "a pointer is null");
  } catch (const std::bad_alloc&) {
    return fail(CCDT_LIMIT_REACHED, "out of memory", "use longer edges, or a machine with more memory");
  } catch (const std::exception& error) {
    return fail(CCDT_BUG, error.what(), "please report this with the input");
  } catch (...) {  // from a size function in C++
    return fail(CCDT_BUG, "an exception of an unknown type", "end size functions without an exception");
  }
}

template <class... Pointers>
void require(Pointers... pointers) {
  const bool are_there = ((pointers != nullptr) && ...);
  if (!are_there) throw NullPointer();
}

/// Runs something that makes a value for a new handle.
template <class Handle, class Make>
ccdt_status make_handle(Handle** handle, const Make& make) {
  return guarded([&] {
    require(handle);
    *handle = new Handle{make()};
  });
}

/// Gives C a list of the engine as numbers, one after the other.
template <class Number, class List>
ccdt_status give(const List& list, const Number** numbers, std::size_t* count) {
  *numbers = reinterpret_cast<const Number*>(list.data());
  *count = list.size();
  return CCDT_DONE;
}
template <class Number, class Handle, class GetList>
ccdt_status give_list(const Handle* handle, const Number** numbers, std::size_t* count, const GetList& list_of) {
  return guarded([&] {
    require(handle, numbers, count);
    give(list_of(*handle), numbers, count);
  });
}

template <std::size_t Size>
std::vector<std::array<std::uint32_t, Size>> rows_of(const std::uint32_t* indices, std::size_t count) {
  std::vector<std::array<std::uint32_t, Size>> rows(count);
  for (std::size_t i = 0; i < Size * count; ++i) rows[i / Size][i % Size] = indices[i];
  return rows;
}

Point3 point_at(const double* coordinates) {
  return {coordinates[0], coordinates[1], coordinates[2]};
}

ccdt::Progress progress_of(const ccdt_options* options) {
  if (options == nullptr || options->cancel_flag == nullptr) return {};
  return [flag = const_cast<int*>(options->cancel_flag)](std::string_view, std::uint64_t, std::uint64_t) {
    if (ccdt::as_atomic(*flag).load() != 0) throw Canceled();
  };
}

const ccdt::MeshOptions& options_of(const ccdt_options* options) {
  static const ccdt::MeshOptions defaults;
  return options == nullptr ? defaults : options->options;
}

/// \throw InputError  the surface cannot be meshed
void check(const ccdt::InputPlc& plc) {
  for (const ccdt::repair::Fault& fault : ccdt::find_faults(plc).faults) {
    if (!fault.is_error) continue;
    std::string what(ccdt::name_of(fault.kind));
    if (!fault.detail.empty()) what += ": " + fault.detail;
    throw InputError(what, fault.places.empty() ? Place{} : fault.places.front(), "repair the surface");
  }
}

}  // namespace

const char* ccdt_version() {
  return ccdt::engine_version.data();
}

const char* ccdt_error_text() {
  return last_error.text.c_str();
}
const char* ccdt_error_remedy() {
  return last_error.remedy.c_str();
}
const char* ccdt_error_file() {
  return last_error.place.file.c_str();
}
long long ccdt_error_line() {
  return last_error.place.line;
}
const double* ccdt_error_points(std::size_t* count) {
  const double* points = nullptr;
  give(last_error.place.points, &points, count);
  return points;
}
const long long* ccdt_error_facets(std::size_t* count) {
  const long long* facets = nullptr;
  give(last_error.place.facets, &facets, count);
  return facets;
}

ccdt_status ccdt_surface_read(const char* file, ccdt_surface** surface) {
  return make_handle(surface, [&] {
    require(file);
    return ccdt::read_plc(file);
  });
}

ccdt_status ccdt_surface_new(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
                             std::size_t triangle_count, const int* markers, ccdt_surface** surface) {
  return make_handle(surface, [&] {
    require(vertices);
    if (triangle_count > 0) require(triangles);
    ccdt::InputPlc plc;
    for (std::size_t v = 0; v < vertex_count; ++v) plc.vertices.push_back(point_at(vertices + 3 * v));
    plc.triangles = rows_of<3>(triangles, triangle_count);
    if (markers != nullptr) plc.triangle_markers.assign(markers, markers + triangle_count);
    return plc;
  });
}

ccdt_status ccdt_surface_add_polygon(ccdt_surface* surface, const std::uint32_t* corners, std::size_t count,
                                     int marker) {
  return guarded([&] {
    require(surface, corners);
    const auto number = static_cast<std::uint32_t>(surface->plc.facet_count());
    surface->plc.polygon_facets.push_back({{{corners, corners + count}}, {}, marker, number});
  });
}

ccdt_status ccdt_surface_add_segment(ccdt_surface* surface, std::uint32_t a, std::uint32_t b, int marker) {
  return guarded([&] {
    require(surface);
    surface->plc.segment_markers.resize(surface->plc.segments.size());  // those of a file may have none
    surface->plc.segments.push_back({a, b});
    surface->plc.segment_markers.push_back(marker);
  });
}

ccdt_status ccdt_surface_add_hole(ccdt_surface* surface, const double point[3]) {
  return guarded([&] {
    require(surface, point);
    surface->plc.holes.push_back(point_at(point));
    surface->plc.inside = ccdt::InputPlc::Inside::seeds;
  });
}

ccdt_status ccdt_surface_add_region(ccdt_surface* surface, const double point[3], int number, double largest_volume) {
  return guarded([&] {
    require(surface, point);
    surface->plc.regions.push_back({point_at(point), number, largest_volume});
    surface->plc.inside = ccdt::InputPlc::Inside::seeds;
  });
}

ccdt_status ccdt_surface_check(const ccdt_surface* surface) {
  return guarded([&] {
    require(surface);
    check(surface->plc);
  });
}

ccdt_status ccdt_surface_repair(const ccdt_surface* surface, double gap, double limit, ccdt_surface** repaired) {
  return make_handle(repaired, [&] {
    require(surface);
    ccdt::repair::Repaired result = ccdt::repair_input(surface->plc, {.gap = gap, .limit = limit});
    if (!result.refused.empty()) throw InputError(result.refused.front(), {}, "allow it by a larger limit");
    if (result.is_out_of_time) throw ccdt::LimitError("the surface cannot be repaired in time", {}, "use the program");
    return std::move(result.input);
  });
}

ccdt_status ccdt_surface_write(const ccdt_surface* surface, const char* file) {
  return guarded([&] {
    require(surface, file);
    ccdt::write_plc(surface->plc, file);
  });
}

ccdt_status ccdt_surface_vertices(const ccdt_surface* surface, const double** coordinates, std::size_t* count) {
  return give_list(
      surface, coordinates, count, [](const auto& handle) -> auto& { return handle.plc.vertices; });
}

ccdt_status ccdt_surface_triangles(const ccdt_surface* surface, const std::uint32_t** corners, std::size_t* count) {
  return give_list(
      surface, corners, count, [](const auto& handle) -> auto& { return handle.plc.triangles; });
}

void ccdt_surface_free(ccdt_surface* surface) {
  delete surface;
}

ccdt_status ccdt_options_new(ccdt_options** options) {
  return make_handle(options, [] { return ccdt::MeshOptions(); });
}

ccdt_status ccdt_options_set(ccdt_options* options, const char* name, const char* value) {
  return guarded([&] {
    require(options, name, value);
    const std::string_view option = name;
    if (option == "size-field" || option == "size_field")
      throw InputError("the library does not read size fields", {.file = value}, "give a size function");
    if (option == "sizes")
      options->options.background = ccdt::read_sizes(value);
    else
      ccdt::options::set_option(option, value, options->options);
  });
}

ccdt_status ccdt_options_set_size_function(ccdt_options* options,
                                           void (*function)(const double* points, std::size_t count, double* lengths,
                                                            void* data),
                                           void* data) {
  return guarded([&] {
    require(options, function);
    options->options.local.function = [=](std::span<const Point3> points, std::span<double> lengths) {
      function(reinterpret_cast<const double*>(points.data()), points.size(), lengths.data(), data);
    };
  });
}

ccdt_status ccdt_options_set_cancel_flag(ccdt_options* options, const int* flag) {
  return guarded([&] {
    require(options);
    options->cancel_flag = flag;
  });
}

void ccdt_options_free(ccdt_options* options) {
  delete options;
}

ccdt_status ccdt_mesh_make(const ccdt_surface* surface, const ccdt_options* options, ccdt_mesh** mesh) {
  return make_handle(mesh, [&] {
    require(surface);
    return ccdt::mesh_plc(surface->plc, options_of(options), progress_of(options)).mesh;
  });
}

ccdt_status ccdt_mesh_read(const char* file, ccdt_mesh** mesh) {
  return make_handle(mesh, [&] {
    require(file);
    return ccdt::read_tet_mesh(file);
  });
}

ccdt_status ccdt_mesh_improve(const ccdt_mesh* mesh, const ccdt_options* options, ccdt_mesh** better) {
  return make_handle(better, [&] {
    require(mesh);
    const ccdt::MeshOptions& chosen = options_of(options);
    return ccdt::improve_tet_mesh(mesh->mesh, chosen.improve, chosen.threads, progress_of(options)).mesh;
  });
}

ccdt_status ccdt_mesh_write(const ccdt_mesh* mesh, const char* file) {
  return guarded([&] {
    require(mesh, file);
    ccdt::write_tet_mesh(mesh->mesh, file);
  });
}

ccdt_status ccdt_mesh_vertices(const ccdt_mesh* mesh, const double** coordinates, std::size_t* count) {
  return give_list(
      mesh, coordinates, count, [](const auto& handle) -> auto& { return handle.mesh.vertices; });
}

ccdt_status ccdt_mesh_tetrahedra(const ccdt_mesh* mesh, const std::uint32_t** corners, std::size_t* count) {
  return give_list(
      mesh, corners, count, [](const auto& handle) -> auto& { return handle.mesh.tetrahedra; });
}

ccdt_status ccdt_mesh_regions(const ccdt_mesh* mesh, const int** numbers, std::size_t* count) {
  return give_list(
      mesh, numbers, count, [](const auto& handle) -> auto& { return handle.mesh.regions; });
}

ccdt_status ccdt_mesh_faces(const ccdt_mesh* mesh, const std::uint32_t** corners, std::size_t* count) {
  return give_list(
      mesh, corners, count, [](const auto& handle) -> auto& { return handle.mesh.faces; });
}

ccdt_status ccdt_mesh_face_markers(const ccdt_mesh* mesh, const int** markers, std::size_t* count) {
  return give_list(
      mesh, markers, count, [](const auto& handle) -> auto& { return handle.mesh.face_markers; });
}

ccdt_status ccdt_mesh_edges(const ccdt_mesh* mesh, const std::uint32_t** ends, std::size_t* count) {
  return give_list(
      mesh, ends, count, [](const auto& handle) -> auto& { return handle.mesh.edges; });
}

ccdt_status ccdt_mesh_edge_markers(const ccdt_mesh* mesh, const int** markers, std::size_t* count) {
  return give_list(
      mesh, markers, count, [](const auto& handle) -> auto& { return handle.mesh.edge_markers; });
}

void ccdt_mesh_free(ccdt_mesh* mesh) {
  delete mesh;
}
