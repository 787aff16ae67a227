"""An option that takes one value is refused where it stands twice: the last went before the others, without a word."""

import click
import pytest
from click.testing import CliRunner

from seisblock.cli import COMMANDS, main


def single_value_options(name):
    """Return the options of a command that take one value, by their longest names."""
    params = main.get_command(click.Context(main), name).params
    options = (param for param in params if isinstance(param, click.Option) and not (param.multiple or param.is_flag))
    return [max(option.opts, key=len) for option in options]


@pytest.mark.parametrize("name", COMMANDS)
def test_repeated_single_value_option_is_rejected(name):
    """Of every command and every such option, whichever way it is written, and before anything is read."""
    for option in single_value_options(name):
        result = CliRunner().invoke(main, [name, option, "1", f"{option}=2", "no_such_record.csv"])
        assert result.exit_code == 2
        assert f"{option} may be given only once, found 2" in " ".join(result.stderr.split()), result.output


def test_multiple_options_and_flags_may_be_repeated():
    """Components accumulate, the last of two flags applies, and help is printed."""
    words = ["measure", "synthetic_jma.csv", "--component", "NS", "--component", "EW", "--gal", "--si", "--quiet", "--quiet"]
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 0 and "m/s²" in result.stdout
    assert CliRunner().invoke(main, ["slide", "--mu", "0.1", "--mu", "0.2", "--help"]).exit_code == 0


def test_repeated_option_error_is_translated():
    """As everything is."""
    result = CliRunner().invoke(main, ["overturn-rate", "--cemetery", "a.csv", "--cemetery", "b.csv", "--lang", "ja"])
    assert result.exit_code == 2 and "--cemetery は 1 回だけ指定できます" in result.stderr
