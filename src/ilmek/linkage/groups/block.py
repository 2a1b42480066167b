"""Any group without a closed form, by Newton's method on its loop equations."""

from ilmek.linkage.groups.group import Group, Step


def of(group: Group) -> Step:
    raise NotImplementedError
