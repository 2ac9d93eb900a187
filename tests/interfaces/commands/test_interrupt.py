"""Ctrl-C reaches the command even where an exception is swallowed, and only once."""

import os
import signal
import sys
import time

import pytest

from motionese.interfaces.commands.exit_status import interruptible


def press():
    os.kill(os.getpid(), signal.SIGINT)


class Swallowing:
    def __del__(self):
        press()


def test_what_is_swallowed_is_raised_again_and_not_told(capfd):
    with pytest.raises(KeyboardInterrupt), interruptible():
        Swallowing()
        time.sleep(5)
        pytest.fail("Ctrl-C was lost")
    assert capfd.readouterr() == ("", "")


def test_other_exceptions_that_cannot_be_raised_are_told(monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda what: told.append(what.exc_type))

    class Failing:
        def __del__(self):
            raise ZeroDivisionError

    with interruptible():
        Failing()
    assert told == [ZeroDivisionError]


def test_pressed_again_during_cleanup_it_does_not_disturb_it():
    cleaned = False
    with pytest.raises(KeyboardInterrupt), interruptible():
        try:
            press()
        finally:
            press()
            time.sleep(0.3)
            cleaned = True
    assert cleaned


def test_afterwards_signals_are_handled_as_before():
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGALRM)
    with pytest.raises(KeyboardInterrupt), interruptible():
        press()
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGALRM)) == before
    time.sleep(0.3)
