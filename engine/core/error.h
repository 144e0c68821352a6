#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace meltpoint {

/// What went wrong, seen from the user: it decides the exit code of the program.
enum class ErrorKind {
    Input,   ///< a file, flag or scene that the user can correct (exit code 2)
    Device,  ///< no Vulkan device, a missing feature, out of device memory, a lost device (exit code 1)
    Runtime, ///< anything else that failed while running: a full disk, a simulation that broke down (exit code 1)
};

/// The one exception type of the engine. what() is one clear sentence for the user, without a trailing period.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {} ///< one sentence

    [[nodiscard]] ErrorKind kind() const noexcept { return kind_; } ///< who can mend it

private:
    ErrorKind kind_;
};

/// Error{ErrorKind::Input} with a message formatted by fmt.
template <class... Args>
[[nodiscard]] Error input_error(fmt::format_string<Args...> format, Args&&... args)
{
    return {ErrorKind::Input, fmt::format(format, std::forward<Args>(args)...)};
}

/// Error{ErrorKind::Device} with a message formatted by fmt.
template <class... Args>
[[nodiscard]] Error device_error(fmt::format_string<Args...> format, Args&&... args)
{
    return {ErrorKind::Device, fmt::format(format, std::forward<Args>(args)...)};
}

/// Error{ErrorKind::Runtime} with a message formatted by fmt.
template <class... Args>
[[nodiscard]] Error runtime_error(fmt::format_string<Args...> format, Args&&... args)
{
    return {ErrorKind::Runtime, fmt::format(format, std::forward<Args>(args)...)};
}

} // namespace meltpoint
