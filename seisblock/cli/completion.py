"""``seisblock completion``: completion scripts for bash, zsh and fish."""

from __future__ import annotations

import click
from click.shell_completion import BashComplete, add_completion_class

from seisblock.cli.command import Command, argument
from seisblock.cli.console import print_result
from seisblock.cli.suggest import SuggestingChoice
from seisblock.core.i18n import lazy_gettext

VARIABLE = "_SEISBLOCK_COMPLETE"

INSTALL_HINTS = {
    "bash": lazy_gettext("add to {file}: {line}", file="~/.bashrc", line='eval "$(seisblock completion bash)"'),
    "zsh": lazy_gettext("add to {file}: {line}", file="~/.zshrc", line='eval "$(seisblock completion zsh)"'),
    "fish": lazy_gettext("{line}", line="seisblock completion fish > ~/.config/fish/completions/seisblock.fish"),
}


SCRIPT = """\
%(complete_func)s() {
    local IFS=$'\\n' word=${COMP_WORDS[COMP_CWORD]} line kind value
    [[ $word == "=" ]] && word=
    COMPREPLY=()
    for line in $(env COMP_WORDS="${COMP_WORDS[*]}" COMP_CWORD=$COMP_CWORD %(complete_var)s=bash_complete "$1"); do
        IFS=, read -r kind value <<< "$line"
        if [[ $kind == file ]]; then
            compopt -o filenames
            COMPREPLY+=($(compgen -f -- "$word"))
        else
            COMPREPLY+=("$value")
        fi
    done
}
complete -o nosort -F %(complete_func)s %(prog_name)s
"""
"""Bash completion script; click's own omits the offered names where files are allowed."""


class Bash(BashComplete):
    """Bash completion that joins ``--component=N``, which bash splits at the equals sign."""

    source_template = SCRIPT

    def get_completion_args(self) -> tuple[list[str], str]:
        """Return the words before the incomplete one, and the incomplete word."""
        words, last = super().get_completion_args()
        return [word for word in words if word != "="], "" if last == "=" else last


add_completion_class(Bash)


@click.command(cls=Command, examples=('eval "$(seisblock completion bash)"', "seisblock completion fish > seisblock.fish"))
@argument("shell", type=SuggestingChoice(INSTALL_HINTS), help="Name of the shell.")
@click.pass_context
def completion(ctx: click.Context, shell: str) -> None:
    """Completion script of a shell; stderr shows the line for the shell's start-up file."""
    from click.shell_completion import get_completion_class

    from seisblock.cli.console import info

    kind = get_completion_class(shell)
    assert kind is not None
    print_result(kind(ctx.find_root().command, {}, "seisblock", VARIABLE).source())
    info(INSTALL_HINTS[shell])
