"""Define types of arguments that accept a case, for editors and type checkers."""

from collections.abc import Mapping
from typing import TypeAlias

from stiction.case.read import Case
from stiction.quantities.arguments import FilePath

CaseFile: TypeAlias = Mapping[str, object] | FilePath  # the tables of a case file, or its path
CaseLike: TypeAlias = Case | CaseFile
