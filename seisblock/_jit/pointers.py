"""Function pointers to compiled kernels (numba first-class functions)."""

from __future__ import annotations

from typing import Any

from numba import types

NO_ADDRESS = -1
"""Address that numba accepts for a function without an implementation."""


class FunctionPointer(types.WrapperAddressProtocol):  # type: ignore[misc]
    """Kernel with stored type and address; of a dispatcher numba looks them up at each call that takes it as an argument, in 30 us.

    One that is never called is not compiled and has no address.
    """

    def __init__(self, kernel: Any, signature: Any, is_called: bool) -> None:
        self._kernel, self._signature, self._address = kernel, signature, NO_ADDRESS
        if is_called:
            result = kernel.exported.get_compile_result(signature)
            self._address = int(result.library.get_pointer_to_function(result.fndesc.llvm_cfunc_wrapper_name))
        # numba's dispatcher reads this attribute before it tries the slower typeof
        self._numba_type_ = types.FunctionType(signature)

    def __wrapper_address__(self) -> int:
        """Return the address of the C function."""
        return self._address

    def signature(self) -> Any:
        """Return the signature."""
        return self._signature

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle without the address, which is valid in this process only."""
        return FunctionPointer, (self._kernel, self._signature, self._address != NO_ADDRESS)

    def __call__(self, *arguments: Any) -> Any:
        """Call the kernel from Python."""
        return self._kernel(*arguments)
