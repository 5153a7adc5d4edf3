// OpenCV's functions that read and write pictures, as a library of the same name that loads OpenCV's own at the first
// call. Debian's loads GDAL and 100 further libraries, which took three quarters of the start of each program that
// links MRPT, although most runs read and write no picture (doc/decisions/deferred_codecs.md).
#include <stdexcept>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <opencv2/imgcodecs.hpp>

namespace {

/// The file of a shared library, and the name of a symbol in it, for an address in it.
Dl_info infoOf(const void* address) {
  Dl_info info{};
  if (dladdr(address, &info) == 0)
    throw std::runtime_error("reading pictures: the address of a function has no library");
  return info;
}

/// OpenCV's library, beside its libopencv_core.
void* library() {
  static void* const handle = [] {
    std::string folder = infoOf(reinterpret_cast<const void*>(&cv::getVersionMajor)).dli_fname;
    folder.resize(folder.rfind('/') + 1);
    void* const opened = dlopen((folder + ROBOSIM_IMGCODECS).c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!opened) throw std::runtime_error(std::string("cannot read or write pictures: ") + dlerror());
    return opened;
  }();
  return handle;
}

/// Calls OpenCV's function of the same name as a function of this file.
template <auto kOwn>
struct OpenCv;
template <typename Result, typename... Arguments, Result (*kOwn)(Arguments...)>
struct OpenCv<kOwn> {
  static Result call(Arguments... arguments) {
    static const auto function = [] {
      const char* const name = infoOf(reinterpret_cast<const void*>(kOwn)).dli_sname;
      void* const found = dlsym(library(), name);
      if (!found) throw std::runtime_error(std::string(ROBOSIM_IMGCODECS " has no function ") + name);
      return reinterpret_cast<Result (*)(Arguments...)>(found);
    }();
    return function(static_cast<Arguments>(arguments)...);
  }
};

using Mats = std::vector<cv::Mat>;

}  // namespace

namespace cv {

Mat imread(const String& filename, int flags) { return OpenCv<&imread>::call(filename, flags); }

bool imreadmulti(const String& filename, Mats& mats, int flags) {
  return OpenCv<static_cast<bool (*)(const String&, Mats&, int)>(&imreadmulti)>::call(filename, mats, flags);
}

bool imreadmulti(const String& filename, Mats& mats, int start, int count, int flags) {
  using Function = bool (*)(const String&, Mats&, int, int, int);
  return OpenCv<static_cast<Function>(&imreadmulti)>::call(filename, mats, start, count, flags);
}

size_t imcount(const String& filename, int flags) { return OpenCv<&imcount>::call(filename, flags); }

bool imwrite(const String& filename, InputArray picture, const std::vector<int>& parameters) {
  return OpenCv<&imwrite>::call(filename, picture, parameters);
}

Mat imdecode(InputArray buffer, int flags) {
  return OpenCv<static_cast<Mat (*)(InputArray, int)>(&imdecode)>::call(buffer, flags);
}

Mat imdecode(InputArray buffer, int flags, Mat* to) {
  return OpenCv<static_cast<Mat (*)(InputArray, int, Mat*)>(&imdecode)>::call(buffer, flags, to);
}

bool imencode(const String& extension, InputArray picture, std::vector<uchar>& buffer,
              const std::vector<int>& parameters) {
  return OpenCv<&imencode>::call(extension, picture, buffer, parameters);
}

bool haveImageReader(const String& filename) { return OpenCv<&haveImageReader>::call(filename); }

bool haveImageWriter(const String& filename) { return OpenCv<&haveImageWriter>::call(filename); }

}  // namespace cv
