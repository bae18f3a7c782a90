#include "python/src/callbacks.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <utility>

#include "python/src/arrays.h"

namespace ccdt::python {
namespace {

/// A Python object that may be copied and destroyed without the GIL.
using Shared = std::shared_ptr<py::object>;

Shared shared(py::object object) {
  return {new py::object(std::move(object)), [](py::object* last) {
            const py::gil_scoped_acquire gil;
            delete last;
          }};
}

/// Says when a call is due. Getting the GIL for all calls would take longer than short stages.
class Limiter {
 public:
  bool is_due(std::string_view stage) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    if (stage_ == stage.data() && now < next_.load()) return false;
    stage_ = stage.data();
    next_ = now + std::chrono::milliseconds(50);
    return true;
  }

 private:
  std::atomic<const char*> stage_ = nullptr;
  std::atomic<std::chrono::steady_clock::duration> next_ = {};
};

}  // namespace

Progress progress_of(py::object function) {
  return [function = shared(std::move(function)), limiter = std::make_shared<Limiter>()](
             std::string_view stage, std::uint64_t done, std::uint64_t total) {
    if (!limiter->is_due(stage)) return;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!function->is_none()) (*function)(py::str(stage.data(), stage.size()), done, total);
  };
}

sizes::SizeFunction size_function_of(py::object function) {
  return [function = shared(std::move(function))](std::span<const Point3> points, std::span<double> lengths) {
    const py::gil_scoped_acquire gil;
    // A copy, which the function may keep.
    Array<double> places({points.size(), std::size_t{3}});
    std::copy(points.begin(), points.end(), reinterpret_cast<Point3*>(places.mutable_data()));
    const py::array_t<double, py::array::c_style | py::array::forcecast> answer((*function)(places));
    if (answer.ndim() != 1 || answer.shape(0) != static_cast<py::ssize_t>(lengths.size()))
      throw py::value_error("the size function must return one length for each of " + std::to_string(points.size()) +
                            " points");
    std::copy_n(answer.data(), lengths.size(), lengths.begin());
  };
}

}  // namespace ccdt::python
