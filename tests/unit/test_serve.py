"""`ilmek serve` without a server: users, passwords, certificates, what is refused; the desk of job orders."""

import asyncio
import datetime as dt
import stat
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from cryptography import x509
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat
from opcua_loom import PROGRAMME, SteppingLoom
from small_programme import small_programme

from ilmek.cli import main
from ilmek.drivers.opcua import users as users_of_server
from ilmek.drivers.opcua.certificate import credentials_pem, make_credentials, parse_credentials
from ilmek.drivers.opcua.job_orders import MOST_JOBS, Job, JobDesk, JobState, ReturnStatus
from ilmek.drivers.opcua.users import TRIES, LoomUser, UserList, UserRight, hashed, matches, parse_hash
from ilmek.errors import IlmekError, LoomError, OutputError, ParameterError
from ilmek.io.programme_file import write_programme
from ilmek.io.secret_file import read_bounded, write_secret
from ilmek.io.users_file import read_users
from ilmek.jobs import serve
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.view import Answer

URI = "urn:ilmek:loom:000000000000"


@pytest.fixture(autouse=True)
def cheap_hashes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Passwords are hashed at a hundredth of the price."""
    monkeypatch.setattr(users_of_server, "COST", 1 << 8)


@pytest.fixture
def settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of settings, empty."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    return tmp_path / "config" / "ilmek" / "opcua"


@pytest.fixture(scope="module")
def programme(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("carpet") / "programme.ilmek"
    write_programme(path, small_programme(4, 12))
    return path


def run(*arguments: object, given: str = "") -> Result:
    return CliRunner().invoke(main, ["serve", *map(str, arguments)], input=given)


def refused(*arguments: object, given: str = "") -> str:
    result = run(*arguments, given=given)
    assert result.exit_code == 2, result.output
    assert "Traceback" not in result.stderr
    return result.stderr


def test_a_user_is_written_for_the_owner_alone(settings: Path) -> None:
    result = run("--add-user", "anna", given="long-enough\n")
    assert result.exit_code == 0
    assert "long-enough" not in result.output
    path = settings / "users.toml"
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert "long-enough" not in path.read_text(encoding="utf-8")
    assert run("--add-user", "anna", "--right", "viewer", given="another-one\n").exit_code == 0
    (name, user), *others = read_users(path, serve.RIGHTS).items()
    assert (name, user.right, others) == ("anna", "viewer", [])
    assert matches("another-one", user.password)
    assert not matches("long-enough", user.password)


def test_bad_users_are_refused(settings: Path, programme: Path) -> None:
    assert "a password of 5 characters; 8 to 256 characters" in refused("--add-user", "anna", given="short\n")
    assert "user name ''" in refused("--add-user", "", given="long-enough\n")
    assert "there is no users file" in refused(programme)
    path = settings / "users.toml"
    write_secret(path, b"[anna]\nright = 'king'\npassword = 'x'\n")
    assert "line 2" in refused(programme)
    write_secret(path, b"[anna]\nright = 'viewer'\n")
    assert "password" in refused(programme)
    write_secret(path, b"[anna]\nright = 'viewer'\npassword = 'plain'\n")
    assert "is not one of ilmek" in refused(programme)
    path.write_bytes(b"\xff\xfe")
    assert "is not UTF-8" in refused(programme)
    path.chmod(0o644)
    assert "others can read or write" in refused(programme)


def test_where_a_server_listens_is_checked(settings: Path, programme: Path) -> None:
    assert "no PROGRAMME.ilmek" in refused()
    assert "--port 0; 1 to 65535" in refused(programme, "--port", 0)
    assert "--host 0.0.0.0 without a certificate" in refused(programme, "--host", "0.0.0.0")
    assert "one of --certificate and --key" in refused(programme, "--certificate", "x.pem")
    assert run("--add-user", "anna", given="long-enough\n").exit_code == 0
    given = ("--certificate", settings / "users.toml", "--key", settings / "users.toml")
    assert "is not a certificate" in refused(programme, *given)
    assert "cannot be read" in refused(programme, "--certificate", "nowhere.pem", "--key", "nowhere.pem")


def test_without_the_extra_it_is_named(monkeypatch: pytest.MonkeyPatch, programme: Path) -> None:
    monkeypatch.setattr(serve, "find_spec", lambda _: None)
    assert 'pip install "ilmek[control]"' in refused(programme)


def test_a_certificate_is_made_once_and_kept(settings: Path) -> None:
    plate = serve.nameplate(small_programme(4, 12), "carpet")
    found = [serve._credentials(serve.ServeOrder(), plate) for _ in range(2)]
    assert found[0].certificate == found[1].certificate
    assert found[0].uri == plate.uri
    assert {stat.S_IMODE(path.stat().st_mode) for path in settings.iterdir()} == {0o600}


def test_certificates_that_cannot_serve_are_refused() -> None:
    certificate, key = credentials_pem(make_credentials(URI, "loom", ("127.0.0.1", "localhost")))
    other, _ = credentials_pem(make_credentials(URI, "loom", ()))
    elliptic = ec.generate_private_key(ec.SECP256R1()).private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    assert parse_credentials(certificate, key, URI).uri == URI
    der = x509.load_pem_x509_certificate(certificate).public_bytes(Encoding.DER)
    assert parse_credentials(der, key, URI).certificate.not_valid_after_utc > dt.datetime.now(dt.UTC)
    for given, private, uri, reason in (
        (other, key, URI, "is not that of the key"),
        (certificate, key, "urn:other", "is for urn:ilmek:loom"),
        (certificate, elliptic, URI, "of another kind"),
        (certificate, certificate, URI, "not a private key"),
        (b"-----BEGIN", key, URI, "not a certificate"),
    ):
        with pytest.raises(LoomError, match=reason):
            parse_credentials(given, private, uri)


def test_secrets_of_others_are_not_read(tmp_path: Path) -> None:
    path = tmp_path / "secret"
    write_secret(path, b"x")
    assert read_bounded(path, "key") == b"x"
    path.write_bytes(bytes(100_001))
    for name in ("secret", ".", "nowhere"):
        with pytest.raises(LoomError):
            read_bounded(tmp_path / name, "key")
    with pytest.raises(OutputError):
        write_secret(path / "below", b"x")


def test_passwords_are_tried_slowly() -> None:
    users = UserList({"anna": LoomUser("anna", UserRight.OPERATOR, hashed("long-enough"))})
    assert users.admitted("here", None, None) is None
    assert UserList({}, anonymous=True).admitted("here", None, None) is UserRight.VIEWER
    for name in ("anna", "nobody", "anna", "nobody", "anna")[:TRIES]:
        assert users.admitted("there", name, "wrong-password") is None
    assert users.admitted("there", "anna", "long-enough") is None  # for a minute
    assert users.admitted("here", "anna", "long-enough") is UserRight.OPERATOR
    assert users.admitted("there", "anna", "long-enough") is UserRight.OPERATOR  # a password known to be right


@pytest.mark.parametrize("stored", ["", "scrypt$2$8$1$AA==$AA==", "plain", "scrypt$256$8$1$AA==$AA=="])
def test_hashes_of_others_are_refused(stored: str) -> None:
    with pytest.raises(ParameterError, match="is not one of ilmek"):
        parse_hash(stored)


class Desk:
    """A desk and its loom, looked at by hand."""

    def __init__(self) -> None:
        self.loom = SteppingLoom(total=48, step=4)
        self.refuses: str | None = None
        self.states: list[JobState] = []
        self.desk = JobDesk(PROGRAMME, self.command, lambda job: self.states.append(job.state))

    async def command(self, name: str) -> Answer:
        return self.loom.command(name) if self.refuses is None else Answer(False, self.refuses)

    def store(self, name: str, state: JobState = JobState.ALLOWED_TO_START, **more: object) -> ReturnStatus:
        return self.desk.store(Job(name, state=state, **more), self.loom.snapshot())  # type: ignore[arg-type]

    def look(self, times: int = 1) -> None:
        for _ in range(times):
            asyncio.run(self.desk.advance(self.loom.snapshot()))

    def job(self, name: str) -> Job:
        return next(job for job in self.desk.jobs if job.order == name)


def test_the_desk_starts_the_job_of_the_highest_priority() -> None:
    desk = Desk()
    assert desk.store("low") is desk.store("high", priority=5) is ReturnStatus.NO_ERROR
    desk.look(3)
    assert (desk.job("low").state, desk.job("high").state) == (JobState.ALLOWED_TO_START, JobState.RUNNING)
    assert asyncio.run(desk.desk.pause("high")) is ReturnStatus.NO_ERROR
    assert asyncio.run(desk.desk.pause("low")) is ReturnStatus.INVALID_STATUS
    desk.look(2)
    assert desk.job("high").state is JobState.INTERRUPTED
    assert asyncio.run(desk.desk.resume("high", desk.loom.snapshot())) is ReturnStatus.NO_ERROR
    desk.look(2)
    assert asyncio.run(desk.desk.stop("high")) is ReturnStatus.NO_ERROR
    desk.look(2)
    assert desk.job("high").state is JobState.ENDED
    assert not desk.job("high").completed
    desk.look(30)
    assert desk.job("low").completed
    begun = desk.job("low").knots[0]
    assert desk.job("low").knots == (begun, 48)
    assert 0 < begun < 48


def test_a_refused_start_is_reported_once() -> None:
    desk = Desk()
    desk.refuses = "the door is open"
    desk.store("job")
    desk.look(3)
    assert (desk.job("job").state, desk.job("job").remark) == (JobState.NOT_ALLOWED_TO_START, "the door is open")
    assert desk.states == [JobState.ALLOWED_TO_START, JobState.NOT_ALLOWED_TO_START]
    assert desk.desk.start("job") is ReturnStatus.NO_ERROR
    assert desk.desk.revoke_start("job") is ReturnStatus.NO_ERROR
    assert desk.desk.cancel("job") is ReturnStatus.NO_ERROR
    assert desk.desk.cancel("job") is ReturnStatus.UNKNOWN_JOB_ORDER


def test_an_abort_at_the_loom_ends_the_job() -> None:
    desk = Desk()
    desk.store("job")
    desk.look(4)
    desk.loom.command("abort")
    desk.look()
    assert desk.job("job").state is JobState.ABORTED
    assert asyncio.run(desk.desk.abort("job")) is ReturnStatus.INVALID_STATUS
    assert desk.desk.clear("job") is ReturnStatus.NO_ERROR


def test_a_loom_that_weaves_already_takes_the_job() -> None:
    desk = Desk()
    desk.loom.state = PackState.EXECUTE
    desk.store("job")
    desk.look()
    assert desk.job("job").state is JobState.RUNNING
    assert desk.loom.given == []


def test_the_desk_is_bounded() -> None:
    desk = Desk()
    found = [desk.store(f"job {number}", JobState.NOT_ALLOWED_TO_START) for number in range(MOST_JOBS + 1)]
    assert found[-2:] == [ReturnStatus.NO_ERROR, ReturnStatus.UNABLE_TO_ACCEPT]
    for name in ("", "x" * 101, "a\nb", "job 0"):
        assert desk.store(name) is ReturnStatus.INVALID_REQUEST
    asyncio.run(desk.desk.abort("job 3"))
    assert desk.job("job 3").state is JobState.ABORTED


def test_errors_are_those_of_ilmek(programme: Path, tmp_path: Path) -> None:
    users = tmp_path / "users.toml"
    write_secret(users, b"[a]\n" * 2)
    with pytest.raises(IlmekError, match="users.toml"):
        serve.loom_server(SteppingLoom(), small_programme(4, 12), "carpet", serve.ServeOrder(users=users), print)
