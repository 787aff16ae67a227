"""A compiled kernel with its address, as numba's first-class functions want it."""

from __future__ import annotations

from typing import Any

from numba import types


class FunctionPointer(types.WrapperAddressProtocol):  # type: ignore[misc]
    """A compiled kernel that numba's calls need not ask again for its type and address.

    Parameters
    ----------
    kernel : OnDemand
        Kept alive as long as the pointer.
    signature : numba signature
        One of those it was compiled for.
    """

    def __init__(self, kernel: Any, signature: Any) -> None:
        self._kernel = kernel
        self._signature = signature
        result = kernel.compiled.get_compile_result(signature)
        self._address = result.library.get_pointer_to_function(result.fndesc.llvm_cfunc_wrapper_name)
        # the attribute by which numba's dispatcher recognises a type without asking
        self._numba_type_ = types.FunctionType(signature)

    def __wrapper_address__(self) -> int:
        """Return the address of the C function."""
        return int(self._address)

    def signature(self) -> Any:
        """Return the signature."""
        return self._signature

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to another process without the address, which means nothing there."""
        return FunctionPointer, (self._kernel, self._signature)

    def __call__(self, *arguments: Any) -> Any:
        """Call the kernel from Python."""
        return self._kernel(*arguments)
